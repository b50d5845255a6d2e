"""Displaced parts are located by a camera, picked and placed; that they lie in their bins is seen, not assumed."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
import pytest

from backends.kinematic_runs import prepare
from bodies.test_sorting import FOLDER, LAB
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_model.skills import SkillLibrary
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.motion.pose import Pose
from skillc_runtime.recording.events import Event, NodeEnded
from skillc_runtime.recording.failure_text import list_details
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.facts import RelationFact
from skillc_runtime.world.state.labels.labelled_text import format_fact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import (
    CAMERA,
    CONTAIN,
    FRAME_ID,
    FURNITURE,
    HAS_SHEET,
    POSITION_RANGE,
    SIZE,
    SKILLC,
    TURN_RANGE,
)

pytestmark = pytest.mark.sim

EYE, PARTS = LAB + "Camera-1", (LAB + "Part-A", LAB + "Part-B")
OVERHEAD = Pose.of((0.45, 0.0, 1.9), (0.0, 1.0, 0.0, 0.0))
WATCHED: list[Change] = [
    AddIndividual(EYE, (CAMERA,)),
    AddRelation(EYE, HAS_SHEET, SKILLC + "depth-camera-sheet"),
    SetProperty(EYE, FRAME_ID, "camera"),
    *placement_changes(EYE, OVERHEAD),
]
DISPLACED: list[Change] = [
    *(SetProperty(part, POSITION_RANGE, 0.02) for part in PARTS),
    *(SetProperty(part, TURN_RANGE, 0.26) for part in PARTS),
]


@cache
def library() -> SkillLibrary:
    return compile_valid(find_library(FOLDER))


def sorted_parts(changes: list[Change], seed: int) -> tuple[Execution, SimulatedCell]:
    prepared = prepare(library(), "sort_parts", FOLDER / "cell.ttl", changes)
    cell = SimulatedCell(WorldModel(prepared.assignment.state), seed)
    return execute_task(prepared, library(), cell), cell


class Thief:
    """Takes a part out of its bin, once, as soon as the hand is empty, and puts it on the table at `y` m."""

    rows = None

    def __init__(self, cell: SimulatedCell, y: float) -> None:
        self._cell, self._y, self.acted = cell, y, False

    def step(self, now: float) -> None:
        """Act when the time has come; called in each step of the simulation."""
        cell = self._cell
        if self.acted or cell.gripper(LAB + "Hand-1").carries is not None or not in_bin(cell, "A"):
            return
        first = cell.model.joint(cell.scene.names[PARTS[0]] + "/free").qposadr[0]
        cell.data.qpos[first : first + 7] = (0.45, self._y, 0.63, 1.0, 0.0, 0.0, 0.0)
        self.acted = True


def in_bin(cell: SimulatedCell, letter: str) -> bool:
    truth = cell.ground_truth
    inside = truth.body_pose(LAB + f"Bin-{letter}").inverse() @ truth.body_pose(LAB + f"Part-{letter}")
    return bool(np.abs(inside.position[:2]).max() < 0.08 and abs(inside.position[2]) < 0.04)


def test_displaced_parts_are_located_sorted_and_seen_in_their_bins() -> None:
    execution, cell = sorted_parts([*WATCHED, *DISPLACED], 1)
    assert execution.status == "succeeded", execution.failure
    assert execution.verified is True
    known = {format_fact(fact.fact): fact.known for fact in execution.facts}
    assert known["lab:Bin-A contain lab:Part-A"] == "sensed"
    assert all(in_bin(cell, letter) for letter in "AB")


SCREEN = LAB + "Screen"
HIDDEN: list[Change] = [
    AddIndividual(SCREEN, (FURNITURE,)),
    SetProperty(SCREEN, FRAME_ID, "screen"),
    *(SetProperty(SCREEN, name, each) for name, each in zip(SIZE, (0.02, 0.02, 0.01), strict=True)),
    *placement_changes(SCREEN, Pose.of((0.45, 0.0, 1.88))),
]
"""A board right before the lens."""


@pytest.mark.parametrize("hidden", [False, True], ids=["seen", "hidden"])
def test_a_part_is_grasped_without_looking_only_if_the_camera_cannot_see_its_place(hidden: bool) -> None:
    prepared = prepare(library(), "sort_parts", FOLDER / "cell.ttl", [*WATCHED, *(HIDDEN if hidden else [])])
    cell, events = SimulatedCell(WorldModel(prepared.assignment.state), 1), list[Event]()
    first = cell.model.joint(cell.scene.names[PARTS[0]] + "/free").qposadr[0]
    cell.data.qpos[first : first + 3] = (-0.8, 0.8, 0.05)
    execution = execute_task(prepared, library(), cell, [events.append])
    failures = [each.failure.message for each in events if isinstance(each, NodeEnded) and each.failure is not None]
    assert execution.status == "failed"
    gone = "lab:Camera-1 sees that lab:Part-A is not where it is believed to be, and does not find it elsewhere"
    closed = "lab:Hand-1 does not hold lab:Part-A: nothing keeps its fingers from closing"
    assert any(gone in each for each in failures) is not hidden
    assert any(closed in each for each in failures) is hidden


def test_without_a_camera_nobody_has_seen_where_the_parts_are() -> None:
    execution, cell = sorted_parts([], 1)
    assert execution.status == "succeeded" and execution.verified is False
    decided = cell.world.deciding_write(RelationFact(LAB + "Bin-A", CONTAIN, PARTS[0]))
    assert decided is not None and decided.evidence == "assumed"


def with_a_thief(y: float, changes: Sequence[Change] = ()) -> tuple[Execution, SimulatedCell, list[str]]:
    """Return also what failed."""
    prepared = prepare(library(), "sort_parts", FOLDER / "cell.ttl", [*WATCHED, *changes])
    cell = SimulatedCell(WorldModel(prepared.assignment.state), 1)
    thief, events = Thief(cell, y), list[Event]()
    cell.people = (*cell.people, thief)  # type: ignore[arg-type]
    execution = execute_task(prepared, library(), cell, [events.append])
    assert thief.acted
    return execution, cell, [e.failure.message for e in events if isinstance(e, NodeEnded) and e.failure is not None]


def test_a_part_that_is_taken_out_of_its_bin_is_missed_and_put_there_again() -> None:
    execution, cell, failures = with_a_thief(-0.35)
    assert any("lab:Part-A is not where it was put: its middle is" in each for each in failures), failures
    assert execution.status == "succeeded" and execution.verified, execution.failure
    assert all(in_bin(cell, letter) for letter in "AB")


ASIDE: list[Change] = placement_changes(EYE, Pose.of((0.45, 0.35, 1.9), (0.0, 1.0, 0.0, 0.0)))
"""The camera where the hand does not hide the first bin from it."""


def test_a_part_that_a_camera_sees_to_be_gone_is_not_believed_in_its_bin_until_it_is_seen_again() -> None:
    execution, cell, failures = with_a_thief(-1.2, ASIDE)
    gone = "lab:Camera-1 sees that lab:Part-A is not where it is believed to be, and does not find it elsewhere"
    assert gone in failures and not in_bin(cell, "A")
    assert execution.status == "failed" and execution.failure is not None
    assert execution.failure.message == gone and execution.failure.causes
    withdrawn = "withdrawn: `lab:Bin-A contain lab:Part-A` (assumed by Release)"
    assert withdrawn in "\n".join(list_details(execution.failure))
    lost = cell.world.deciding_write(RelationFact(LAB + "Bin-A", CONTAIN, PARTS[0], holds=False))
    assert lost is not None and lost.evidence == "sensed" and lost.origin == f"ConfirmPlaced: {gone}"


def test_a_part_that_is_hidden_under_the_hand_is_not_said_to_be_in_its_bin() -> None:
    execution, cell, failures = with_a_thief(-0.05)
    assert not in_bin(cell, "A")
    gone = "lab:Camera-1 sees that lab:Part-A is not where it is believed to be, and does not find it elsewhere"
    assert gone in failures, "the hand hides the middle of its place, but not all of it"
    assert execution.status == "failed" and not cell.world.snapshot().holds(LAB + "Bin-A", CONTAIN, PARTS[0])
