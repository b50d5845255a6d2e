"""How much room things take up: a box each, in the world; and which is over which."""

from __future__ import annotations

import numpy as np

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.frame_tree import FrameTree, frame_tree_of
from skillc_runtime.world.space.oriented_box import OrientedBox
from skillc_runtime.world.state.terms import FURNITURE, MOBILE_ROBOT, SIZE, SURFACE
from skillc_runtime.world.state.world_state import WorldState

TOUCH_M = 0.005
"""Things that are no farther apart than this touch, as far as anybody knows."""

FRAME_HEIGHT = {FURNITURE: 0.5, SURFACE: 0.5, MOBILE_ROBOT: -0.5}
"""Where along z the frame lies, as a share of the height, seen from the middle; in the middle where nothing is said."""


def bounding_box(state: WorldState, individual: str) -> OrientedBox:
    """Return the box of a thing; a thing of which no extent is known at all is a point.

    FrameError when it is nowhere, MissingFact when a part of its extent is not known.
    """
    space = frame_tree_of(state)
    if individual not in space.boxes:
        known = any(state.value(individual, name) is not None for name in SIZE if name in state.stored)
        half = _half(space, individual) if known else np.zeros(3)
        share = next((share for cls, share in FRAME_HEIGHT.items() if state.is_a(individual, cls)), 0.0)
        middle = space.pose(individual) @ Pose.of((0.0, 0.0, -2 * share * half[2]))
        space.boxes[individual] = OrientedBox.of(middle, half)
    return space.boxes[individual]


def solid_box(state: WorldState, individual: str) -> OrientedBox:
    """Return the box of a thing that has an extent; errors as for `box`, MissingFact when it has none."""
    _half(frame_tree_of(state), individual)
    return bounding_box(state, individual)


def _half(space: FrameTree, individual: str) -> Array:
    return np.array([space.number(individual, name) for name in SIZE]) / 2


def gap_below(state: WorldState, upper: str, lower: str) -> float | None:
    """Return how high in m the lowest point of a thing is over the top of another, straight below its middle.

    None when the other is not below its middle at all. FrameError when one is nowhere, MissingFact without a size.
    """
    over = bounding_box(state, upper)
    top = solid_box(state, lower).height_at(float(over.middle.position[0]), float(over.middle.position[1]))
    return None if top is None else over.lowest - top
