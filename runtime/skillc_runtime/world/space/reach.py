"""Compares the reach of an arm and its hand with the distance of an object from its shoulder."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.bounding_boxes import solid_box
from skillc_runtime.world.space.frame_tree import frame_tree_of
from skillc_runtime.world.space.shape.oriented_box import CORNERS
from skillc_runtime.world.state.data_sheet import SheetError, number_of, sheet_of
from skillc_runtime.world.state.python_calls import InsufficientFacts
from skillc_runtime.world.state.terms import HAND_LENGTH, HAS_GRIPPER, HAS_SHEET, SURFACE

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


class Reach(msgspec.Struct, frozen=True, eq=False):
    """How far an arm reaches from its shoulder with its hand: in m, and (3,) in m in the world."""

    arm: str
    reach_m: float
    shoulder: Array

    def distance_m(self, points: Array) -> float:
        """Return the distance in m of the farthest of points (n, 3), in m in the world, from the shoulder."""
        return float(np.linalg.norm(points - self.shoulder, axis=1).max())

    def distance_beyond(self, points: Array) -> float:
        """Return by how many m the farthest of points (n, 3), in m in the world, is out of reach; below 0 within it."""
        return self.distance_m(points) - self.reach_m


def read_reach(state: WorldState, arm: str, base: Pose) -> Reach:
    """Return the reach of an arm with its base at a pose in the world; InsufficientFacts without its data sheet."""
    try:
        sheet = sheet_of(state, arm)
        reach_m, height_m = sheet.number("reach"), sheet.number("shoulderHeight")
    except SheetError as error:
        raise InsufficientFacts(str(error)) from error
    return Reach(arm, reach_m + hand_length_m(state, arm), base.apply(np.array([0.0, 0.0, height_m])))


def hand_length_m(state: WorldState, arm: str) -> float:
    """Return how far the tool centre point of the longest hand of an arm is from the flange, in m; 0 if unknown."""
    sheets = (sheet for hand in state.objects(arm, HAS_GRIPPER) for sheet in state.objects(hand, HAS_SHEET))
    return max((number_of(state, each, HAND_LENGTH, default=0.0) for each in sheets), default=0.0)


def reach_obstacle(state: WorldState, arm: str, base: Pose, thing: str) -> str | None:
    """Return by how much an object is out of reach for an arm with its base at a pose in the world; None within reach.

    Of a surface every corner must be within reach, of other objects the origin of the frame. InsufficientFacts when the
    arm's data sheet or the pose of the object is missing.
    """
    reach = read_reach(state, arm, base)
    distance_m = reach.distance_m(_points(state, thing))
    if distance_m <= reach.reach_m:
        return None
    short = state.vocabulary.short
    return (
        f"{short(arm)} reaches {reach.reach_m:.2f} m from its shoulder with its hand, and {short(thing)} is up to "
        f"{distance_m:.2f} m away"
    )


def _points(state: WorldState, thing: str) -> Array:
    """Return the points (n, 3) of an object that must be within reach, in m in the world."""
    if not state.is_a(thing, SURFACE):
        return frame_tree_of(state).pose(thing).position[None, :]
    return solid_box(state, thing).corners[CORNERS[:, 2] > 0]
