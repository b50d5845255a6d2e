"""The tree of an operation, after each of its events, has the nodes that start later, with their numbers."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

import pytest

from running_cells.test_operations import run_all
from running_cells.test_reality import ONE_PART, SORTING, make_settings
from running_cells.yard import write_yard
from skillc.cells.journal.reading import JournalReader
from skillc.cells.opening import open_cell
from skillc.cells.settings import CellSettings
from skillc.contract.operation import OperationRequest
from skillc.contract.runs.run_tree import TreeNode
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.run.operation_tree import build_tree
from skillc_model.codec import loads
from skillc_model.skills import SkillLibrary
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import ImplementationChosen, NodeStarted, PlanArrived, PlanMade
from skillc_runtime.recording.mcap.contents import LIBRARY
from skillc_runtime.recording.mcap.reader import read_recording


def run(settings: CellSettings, request: OperationRequest) -> tuple[tuple[Envelope, ...], SkillLibrary]:
    """Run an operation to its end; return its events and its library, as its recording has it."""
    with open_cell(settings, SilentReporter()) as host:
        host.submit("first", request)
        run_all(host)
    with closing(JournalReader(settings.journal)) as reader:
        envelopes = reader.envelopes("first")
    recording = read_recording(Path(settings.folder) / "recordings" / "first.mcap")
    return envelopes, loads(recording.attachments[LIBRARY], "the library")


def nodes_after(envelopes: tuple[Envelope, ...], library: SkillLibrary) -> dict[int, TreeNode]:
    tree = build_tree(envelopes, library)
    assert tree.sequence == len(envelopes)
    for number, each in enumerate(tree.nodes):
        assert each.parent == 0 or each.parent in {earlier.id for earlier in tree.nodes[:number]}
    return {each.id: each for each in tree.nodes}


@pytest.mark.parametrize(
    ("case", "request_"),
    [
        ("yard", OperationRequest(task="carry_all")),
        ("yard", OperationRequest(task="carry_two")),
        ("sorting", ONE_PART),
    ],
)
def test_each_node_is_known_before_it_starts(tmp_path: Path, case: str, request_: OperationRequest) -> None:
    yard = case == "yard"
    settings = write_yard(tmp_path, 20) if yard else make_settings(tmp_path, SORTING, "kinematic")
    envelopes, library = run(settings, request_)
    known, chosen, foretold = dict[int, TreeNode](), set[int](), 0
    for number, each in enumerate(envelopes):
        match each.event:
            case NodeStarted() as start if start.kind == "primitive" or start.parent in chosen:
                known = nodes_after(envelopes[: number + 1], library)  # the root of a body that was just chosen
                chosen.discard(start.parent)
            case NodeStarted() as start:
                known = known or nodes_after(envelopes[:number], library)
                node = known[start.node]
                assert (node.parent, node.kind, node.source) == (start.parent, start.kind, start.source)
                foretold += 1
            case ImplementationChosen() as choice:
                chosen.add(choice.node)
            case PlanMade():
                known = {}
            case _:
                pass
    assert foretold > (10 if yard else 3)
    ended = nodes_after(envelopes, library)
    calls = [each for each in ended.values() if each.kind == "call"]
    assert calls and all(each.skill and each.implementation for each in calls)


def test_a_tree_before_its_plan_is_empty_and_after_it_has_the_steps(tmp_path: Path) -> None:
    envelopes, library = run(write_yard(tmp_path, 20), OperationRequest(task="carry_all"))
    planned = next(number for number, each in enumerate(envelopes) if isinstance(each.event, PlanArrived))
    assert not nodes_after(envelopes[:planned], library), "nothing is planned yet"
    before = nodes_after(envelopes[: planned + 1], library)
    loads_ = [each for each in before.values() if each.skill == "Load"]
    assert {each.attempt for each in before.values()} == {1} and len(loads_) == 6
    assert {each.arguments["crate"] for each in loads_} == {f"lab:crate-{number}" for number in range(6)}
