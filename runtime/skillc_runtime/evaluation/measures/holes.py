"""Pegs that are in sockets."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_runtime.backends.mujoco.fixture_spec import FixtureSpec
from skillc_runtime.backends.mujoco.fixture_variation import FixtureVariation
from skillc_runtime.backends.mujoco.names import part_name
from skillc_runtime.evaluation.measures.evidence import RunEvidence
from skillc_runtime.evaluation.measures.work import InsertingWork, Work
from skillc_runtime.world.state.data_sheet import number_of
from skillc_runtime.world.state.terms import CONTAIN, DEPTH, PEG, SOCKET


def measure(evidence: RunEvidence) -> Iterator[Work]:
    """Yield each peg that the world model says is in a socket."""
    cell, state = evidence.cell, evidence.cell.world.snapshot()
    for fixture, true in zip(cell.scene.fixtures, cell.variation.fixtures, strict=True):
        held = state.objects(fixture.individual, CONTAIN) if state.is_a(fixture.individual, SOCKET) else ()
        for peg in sorted(each for each in held if state.is_a(each, PEG)):
            yield _inserted(evidence, fixture, true, peg)


def _inserted(evidence: RunEvidence, fixture: FixtureSpec, true: FixtureVariation, peg: str) -> InsertingWork:
    cell = evidence.cell
    end = cell.data.site(part_name(cell.scene.names[peg], "face")).xpos
    return InsertingWork(
        socket=cell.scene.names[fixture.individual],
        depth_m=-float(true.true_pose(fixture.pose).inverse().apply(end)[2]),
        hole_m=number_of(cell.world.snapshot(), fixture.individual, DEPTH),
        greatest_n=float(cell.ground_truth.recording(peg).force.max(initial=0.0)),
        took=evidence.duration_share(fixture.individual),
    )
