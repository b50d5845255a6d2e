"""The functions with which skill texts pick and place. Poses are of the tool, in the world; lengths in m, forces in N.

The tool is the empty hand, or the thing that it holds.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.working_face import working_face
from skillc_runtime.world.space.frames import pose, size
from skillc_runtime.world.space.grasping.grasp_geometry import APPROACH_M
from skillc_runtime.world.space.grasping.grasps import find_grasp, stated_pose
from skillc_runtime.world.space.grasping.grip_force import grasp_force_n
from skillc_runtime.world.space.placing.chosen_places import list_places
from skillc_runtime.world.space.placing.held_load import pose_in_hand
from skillc_runtime.world.space.supports import clearance_m
from skillc_runtime.world.state.terms import APPROACH_POSE, HELD_SIDEWAYS

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState

OVER_RIM_M = 0.04
"""How far above the rim of a carrier a thing is brought to its place, and the hand leaves it."""


def grasp_pose(state: WorldState, gripper: str, thing: str, way: str) -> Pose:
    """Return where the hand grasps a thing "above", "across" or from the "side". GraspError if it cannot."""
    return find_grasp(state, gripper, thing, way).tool


def approach_pose(state: WorldState, gripper: str, thing: str, way: str) -> Pose:
    """Return from where the hand approaches a thing in a line: what is stated, else straight before the grasp."""
    stated = stated_pose(state, thing, APPROACH_POSE)
    if stated is not None:
        return pose(state, stated)
    return find_grasp(state, gripper, thing, way).tool @ Pose.of((0.0, 0.0, -APPROACH_M))


def carried(state: WorldState, thing: str, there: Pose, away: Pose) -> Pose:
    """Return where a thing, as a tool, is when the hand that grasped it at one pose, as it now lies, is at another."""
    return away @ there.inverse() @ pose(state, thing) @ working_face(size(state, thing))


def grasp_opening(state: WorldState, gripper: str, thing: str, way: str) -> float:
    """Return how far the fingers open around a thing, at most as far as they can."""
    return find_grasp(state, gripper, thing, way).opening_m


def grasp_force(state: WorldState, gripper: str, thing: str) -> float:
    """Return the force of a finger: that of the thing, else what carries its weight. GraspError if none does."""
    return grasp_force_n(state, gripper, thing)


def place_pose(state: WorldState, arm: str, gripper: str, thing: str, to: str) -> Pose:
    """Return where the held thing, the tool, stands at a place: where that was chosen, or at a stated pose, if free.

    If neither is, free beside what is known to be there. PlaceError if it cannot be put down there.
    """
    return next(list_places(state, arm, gripper, thing, to)).tool


def hand_pose(state: WorldState, gripper: str, thing: str, at: Pose) -> Pose:
    """Return where the hand is when the thing that it holds, the tool, is at a pose."""
    return at @ working_face(size(state, thing)).inverse() @ pose_in_hand(state, gripper, thing).inverse()


def above_place(state: WorldState, to: str, at: Pose) -> Pose:
    """Return a pose moved up so far that a tool there is above the rim of a carrier."""
    return Pose(at.position + np.array([0.0, 0.0, max(0.1, clearance_m(state, to) + OVER_RIM_M)]), at.rotation)


def retreat_pose(state: WorldState, gripper: str, thing: str, to: str, at: Pose) -> Pose:
    """Return where the hand goes in a line from the held thing that it leaves at a pose: up, or back if horizontal."""
    hand = hand_pose(state, gripper, thing, at)
    if state.value(thing, HELD_SIDEWAYS) is True:
        return hand @ Pose.of((0.0, 0.0, -APPROACH_M))
    return above_place(state, to, hand)


def upwards(_state: WorldState) -> Array:
    """Return the direction (3,) upwards, of length 1."""
    return np.array([0.0, 0.0, 1.0])
