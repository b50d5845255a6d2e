"""Measures the insertion of pegs into sockets."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_runtime.backends.simulation.fixture_spec import FixtureSpec
from skillc_runtime.backends.simulation.fixture_variation import FixtureVariation
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.evaluation.measures.evidence import RunEvidence
from skillc_runtime.evaluation.measures.work import InsertingWork, Work
from skillc_runtime.world.state.data_sheet import number_of
from skillc_runtime.world.state.terms import CONTAIN, DEPTH, PEG, SOCKET


def measure(evidence: RunEvidence) -> Iterator[Work]:
    """Yield the insertion of each peg that is in a socket according to the world model."""
    cell, state = evidence.cell, evidence.cell.world.snapshot()
    for fixture, variation in zip(cell.scene.fixtures, cell.variation.fixtures, strict=True):
        held = state.objects(fixture.individual, CONTAIN) if state.is_a(fixture.individual, SOCKET) else ()
        for peg in sorted(each for each in held if state.is_a(each, PEG)):
            yield _measure_insertion(evidence, fixture, variation, peg)


def _measure_insertion(
    evidence: RunEvidence, fixture: FixtureSpec, variation: FixtureVariation, peg: str
) -> InsertingWork:
    cell = evidence.cell
    end = cell.data.site(part_name(cell.scene.names[peg], "face")).xpos
    return InsertingWork(
        socket=cell.scene.names[fixture.individual],
        depth_m=-float(variation.true_pose(fixture.pose).inverse().apply(end)[2]),
        hole_depth_m=number_of(cell.world.snapshot(), fixture.individual, DEPTH),
        greatest_n=float(cell.ground_truth.recording(peg).force.max(initial=0.0)),
        duration_share=evidence.duration_share(fixture.individual),
    )
