"""Displaced parts are located by a camera, picked and placed; that they lie in their bins is seen, not assumed."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from backends.kinematic_runs import prepare
from bodies.test_sorting import FOLDER, LAB
from skillc.services import libraries
from skillc.services.library_files import find_library
from skillc_model.skills import SkillLibrary
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.facts import RelationFact
from skillc_runtime.world.state.labelled_text import format_fact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CAMERA, CONTAIN, FRAME_ID, HAS_SHEET, POSITION_RANGE, SKILLC, TURN_RANGE

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
    outcome = libraries.compile_library(find_library(FOLDER))
    assert outcome.ok, outcome.diagnostics
    return outcome.value


def sorted_parts(changes: list[Change], seed: int) -> tuple[Execution, SimulatedCell]:
    prepared = prepare(library(), "sort_parts", FOLDER / "cell.ttl", changes)
    cell = SimulatedCell(WorldModel(prepared.assignment.state), seed)
    return execute_task(prepared, library(), cell), cell


def in_bin(cell: SimulatedCell, letter: str) -> bool:
    truth = cell.ground_truth
    inside = truth.body_pose(LAB + f"Bin-{letter}").inverse() @ truth.body_pose(LAB + f"Part-{letter}")
    return bool(np.abs(inside.position[:2]).max() < 0.08 and abs(inside.position[2]) < 0.04)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_displaced_parts_are_located_sorted_and_seen_in_their_bins(seed: int) -> None:
    execution, cell = sorted_parts([*WATCHED, *DISPLACED], seed)
    assert execution.status == "succeeded", execution.failure
    assert execution.verified is True
    known = {format_fact(fact.fact): fact.known for fact in execution.facts}
    assert known["lab:Bin-A contain lab:Part-A"] == "sensed"
    assert all(in_bin(cell, letter) for letter in "AB")


def test_without_a_camera_nobody_has_seen_where_the_parts_are() -> None:
    execution, cell = sorted_parts([], 1)
    assert execution.status == "succeeded" and execution.verified is False
    decided = cell.world.deciding_write(RelationFact(LAB + "Bin-A", CONTAIN, PARTS[0]))
    assert decided is not None and decided.evidence == "assumed"
