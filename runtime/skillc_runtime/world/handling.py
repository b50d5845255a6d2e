"""The functions with which skill texts pick and place. Poses are of the tool, in the world; lengths in m, forces in N.

The tool is the empty hand, or the thing that it holds.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.working_face import working_face
from skillc_runtime.world.space.frames import pose, size
from skillc_runtime.world.space.free_places import clearance_m, free_hand_pose, pose_in_hand
from skillc_runtime.world.space.grasps import find_grasp, grasp_force_n, grasp_opening_m, stated_pose
from skillc_runtime.world.state.terms import APPROACH_POSE, PLACING_POSE

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState

APPROACH_M = 0.12
"""How far before a grasp a hand approaches in a line."""

OVER_RIM_M = 0.04
"""How far above the rim of a carrier a thing is brought to its place, and the hand leaves it."""


def grasp_pose(state: WorldState, gripper: str, thing: str, choice: int) -> Pose:
    """Return where the hand grasps a thing; choice 1 is the best grasp. GraspError if there is none."""
    return find_grasp(state, gripper, thing, choice).tool


def approach_pose(state: WorldState, gripper: str, thing: str, choice: int) -> Pose:
    """Return from where the hand approaches a thing in a line: what is stated, else straight before the grasp."""
    stated = stated_pose(state, thing, APPROACH_POSE)
    if stated is not None:
        return pose(state, stated)
    return find_grasp(state, gripper, thing, choice).tool @ Pose.of((0.0, 0.0, -APPROACH_M))


def grasp_opening(state: WorldState, gripper: str, thing: str, choice: int) -> float:
    """Return how far the fingers open around a thing, at most as far as they can."""
    return grasp_opening_m(state, gripper, find_grasp(state, gripper, thing, choice))


def grasp_force(state: WorldState, gripper: str, thing: str) -> float:
    """Return the force of a finger: that of the thing, else what carries its weight. GraspError if none does."""
    return grasp_force_n(state, gripper, thing)


def place_pose(state: WorldState, arm: str, gripper: str, thing: str, to: str) -> Pose:
    """Return where the held thing, the tool, stands at a place: as stated, else free beside what is known to be there.

    PlaceError if it cannot be put down there.
    """
    stated = stated_pose(state, to, PLACING_POSE)
    if stated is not None:
        return pose(state, stated)
    hand = free_hand_pose(state, arm, gripper, thing, to)
    return hand @ pose_in_hand(state, gripper, thing) @ working_face(size(state, thing))


def hand_pose(state: WorldState, gripper: str, thing: str, at: Pose) -> Pose:
    """Return where the hand is when the thing that it holds, the tool, is at a pose."""
    return at @ working_face(size(state, thing)).inverse() @ pose_in_hand(state, gripper, thing).inverse()


def above_place(state: WorldState, to: str, at: Pose) -> Pose:
    """Return a pose moved up so far that a tool there is above the rim of a carrier."""
    return Pose(at.position + np.array([0.0, 0.0, max(0.1, clearance_m(state, to) + OVER_RIM_M)]), at.rotation)


def upwards(_state: WorldState) -> Array:
    """Return the direction (3,) upwards, of length 1."""
    return np.array([0.0, 0.0, 1.0])
