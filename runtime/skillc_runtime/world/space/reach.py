"""Compares the reach of an arm with the distance of an object from its shoulder."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.bounding_boxes import solid_box
from skillc_runtime.world.space.frame_tree import frame_tree_of
from skillc_runtime.world.space.oriented_box import CORNERS
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.python_calls import InsufficientFacts
from skillc_runtime.world.state.terms import SURFACE

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


def reach_obstacle(state: WorldState, arm: str, base: Pose, thing: str) -> str | None:
    """Return by how much an object is out of reach for an arm with its base at a pose in the world; None within reach.

    Of a surface every corner must be within reach, of other objects the origin of the frame. InsufficientFacts when the
    arm's data sheet or the pose of the object is missing.
    """
    try:
        sheet = sheet_of(state, arm)
        reach_m, height_m = sheet.number("reach"), sheet.number("shoulderHeight")
    except SheetError as error:
        raise InsufficientFacts(str(error)) from error
    shoulder = base.apply(np.array([0.0, 0.0, height_m]))
    distance_m = float(np.linalg.norm(_points(state, thing) - shoulder, axis=1).max())
    if distance_m <= reach_m:
        return None
    short = state.vocabulary.short
    return (
        f"{short(arm)} reaches {reach_m:.2f} m from its shoulder, and {short(thing)} is up to {distance_m:.2f} m away"
    )


def _points(state: WorldState, thing: str) -> Array:
    """Return the points (n, 3) of an object that must be within reach, in m in the world."""
    if not state.is_a(thing, SURFACE):
        return frame_tree_of(state).pose(thing).position[None, :]
    return solid_box(state, thing).corners[CORNERS[:, 2] > 0]
