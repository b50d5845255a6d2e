"""Measures the insertion of pegs into sockets."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_runtime.evaluation.measures.evidence import RunEvidence
from skillc_runtime.evaluation.measures.work import InsertingWork, Work
from skillc_runtime.world.state.data_sheet import number_of
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import CONTAIN, DEPTH, PEG, SOCKET


def measure(evidence: RunEvidence) -> Iterator[Work]:
    """Yield the insertion of each peg that is in a socket according to the world model."""
    state = evidence.state
    for socket in sorted(state.instances(SOCKET)):
        for peg in sorted(each for each in state.objects(socket, CONTAIN) if state.is_a(each, PEG)):
            yield _measure_insertion(evidence, socket, peg)


def _measure_insertion(evidence: RunEvidence, socket: str, peg: str) -> InsertingWork:
    state, truth = evidence.state, evidence.truth
    return InsertingWork(
        socket=label(socket, state.vocabulary),
        depth_m=-float(truth.fixture_pose(socket).inverse().apply(truth.face_position(peg))[2]),
        hole_depth_m=number_of(state, socket, DEPTH),
        greatest_n=float(truth.recording(peg).force.max(initial=0.0)),
        duration_share=evidence.duration_share(socket),
    )
