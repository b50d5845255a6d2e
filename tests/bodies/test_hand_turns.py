"""A derived pose turns the hand so that the last joint of the arm keeps away from the ends of its range."""

from __future__ import annotations

from math import cos, radians, sin
from pathlib import Path

import numpy as np
import pytest

from bodies.test_own_cells import CELLS, LAB, library, written
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.motion.pose import Pose
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.handling import above_place, approach_pose, grasp_pose
from skillc_runtime.world.space.frames import placement_changes, pose, relocation_changes
from skillc_runtime.world.space.placing.free_places import free_hand_pose
from skillc_runtime.world.state.changes import AddRelation
from skillc_runtime.world.state.data_sheet import sheet_of
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import CONTAIN
from skillc_runtime.world.state.world_state import WorldState

ARM, HAND, PART, BIN = (LAB + name for name in ("Panda-1", "Hand-1", "Part-A", "Bin-A"))
OTHERS = (LAB + "Part-B", LAB + "Bin-B")
ROOM_RAD = 0.3
SPOTS = [(0.4, -0.4), (0.45, 0.0), (0.4, 0.4)]


def turned(state: WorldState, thing: str, at: tuple[float, float, float], degrees: float) -> WorldState:
    half = radians(degrees) / 2
    return state.with_changes(list(placement_changes(thing, Pose.of(at, (cos(half), 0.0, 0.0, sin(half))))))


def room_rad(cell: KinematicCell, state: WorldState, *poses: Pose) -> float:
    """Return how far the last joint stays from the ends of its range in poses of the hand, the first from home."""
    arm, q = cell.arm(ARM), sheet_of(state, ARM).posture("home")
    low, high = arm.limits.range[-1]
    found = []
    for each in poses:
        solution = arm.motion.inverse_kinematics(each, q)
        assert solution is not None, each
        q = solution
        found.append(min(q[-1] - low, high - q[-1]))
    return min(found)


@pytest.fixture(params=list(CELLS))
def cell(request: pytest.FixtureRequest, tmp_path: Path) -> KinematicCell:
    state = load_scene(written(tmp_path, CELLS[request.param]), library().vocabulary)
    away = [change for each in OTHERS for change in placement_changes(each, Pose.of((-0.5, 0.0, 0.63)))]
    return KinematicCell(WorldModel(state.with_changes(away)))


@pytest.mark.slow
@pytest.mark.parametrize("way", ["above", "across"])
def test_the_hand_keeps_away_from_the_ends_of_its_joint_over_a_part_that_lies_in_any_direction(
    cell: KinematicCell, way: str
) -> None:
    for x, y in SPOTS:
        for degrees in range(-90, 90, 15):
            state = turned(cell.world.snapshot(), PART, (x, y, 0.63), degrees)
            above, there = (find(state, HAND, PART, way) for find in (approach_pose, grasp_pose))
            assert room_rad(cell, state, above, there) > ROOM_RAD, (x, y, degrees)


def test_the_hand_keeps_away_from_the_ends_of_its_joint_over_a_bin_that_is_turned_in_any_direction(
    cell: KinematicCell,
) -> None:
    start = cell.world.snapshot()
    in_hand = grasp_pose(start, HAND, PART, "above").inverse() @ pose(start, PART)
    for x, y in SPOTS:
        for degrees in range(-180, 180, 30):
            state = turned(start, BIN, (x, y, 0.63), degrees)
            held = [AddRelation(HAND, CONTAIN, PART), *relocation_changes(state, PART, in_hand, "hand")]
            state = state.with_changes(held)
            there = free_hand_pose(state, ARM, HAND, PART, BIN)
            assert room_rad(cell, state, above_place(state, BIN, there), there) > ROOM_RAD, (x, y, degrees)


def test_a_hand_of_a_panda_that_is_turned_back_meets_the_end_of_its_joint(tmp_path: Path) -> None:
    panda = KinematicCell(WorldModel(load_scene(written(tmp_path, []), library().vocabulary)))
    state = turned(panda.world.snapshot(), PART, (0.45, 0.4, 0.63), 0.0)
    there = grasp_pose(state, HAND, PART, "above")
    back = there @ Pose.of((0.0, 0.0, 0.0), (cos(radians(39)), 0.0, 0.0, sin(radians(39))))
    assert room_rad(panda, state, back) < ROOM_RAD < room_rad(panda, state, there)
    assert np.allclose(back.rotation[:, 2], there.rotation[:, 2])
