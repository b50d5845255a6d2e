"""Bounding boxes of objects in the world."""

from __future__ import annotations

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.frame_tree import FrameTree, frame_tree_of
from skillc_runtime.world.space.shape.extents import LocalBox
from skillc_runtime.world.space.shape.oriented_box import OrientedBox
from skillc_runtime.world.state.terms import SIZE
from skillc_runtime.world.state.world_state import WorldState

TOUCH_M = 0.005
"""Objects with at most this distance in m count as touching."""


def bounding_box(state: WorldState, individual: str) -> OrientedBox:
    """Return the bounding box of an object in the world; an object without any known extent is a point.

    FrameError when its pose is not known, MissingFact when a part of its extent is not known.
    """
    space = frame_tree_of(state)
    if individual not in space.boxes:
        known = any(state.value(individual, name) is not None for name in SIZE if name in state.stored)
        half = _half(space, individual) if known else np.zeros(3)
        middle = space.pose(individual) @ Pose(LocalBox.of(half, state.classes.get(individual)).middle, np.eye(3))
        space.boxes[individual] = OrientedBox.of(middle, half)
    return space.boxes[individual]


def solid_box(state: WorldState, individual: str) -> OrientedBox:
    """Return the bounding box of an object in the world; as `bounding_box`, but MissingFact without an extent."""
    _half(frame_tree_of(state), individual)
    return bounding_box(state, individual)


def _half(space: FrameTree, individual: str) -> Array:
    return np.array([space.number(individual, name) for name in SIZE]) / 2
