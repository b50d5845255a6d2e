"""How much room things take up: a box each, in the world."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.space import Space, space_of
from skillc_runtime.world.terms import FURNITURE, MOBILE_ROBOT, SIZE, SURFACE

if TYPE_CHECKING:
    from skillc_runtime.world.state import WorldState

TOUCH_M = 0.005
"""Things that are no farther apart than this touch, as far as anybody knows."""

FRAME_HEIGHT = {FURNITURE: 0.5, SURFACE: 0.5, MOBILE_ROBOT: -0.5}
"""Where along z the frame lies, as a share of the height, seen from the middle; in the middle where nothing is said."""

CORNERS = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])


@dataclass(frozen=True, slots=True, eq=False)
class Box:
    """A box: its middle in the world, half its extent (3,) m along its axes, its corners (8, 3) in the world.

    `lowest` is the height in m of the lowest corner, `axes` are its axes in the world, each with half the extent.
    """

    middle: Pose
    half: Array
    corners: Array
    lowest: float
    axes: tuple[tuple[float, float, float, float], ...]

    @staticmethod
    def of(middle: Pose, half: Array) -> Box:
        """Return the box with its middle at a pose and half its extent (3,) m."""
        corners = CORNERS * half @ middle.rotation.T + middle.position
        axes = tuple((x, y, z, h) for (x, y, z), h in zip(middle.rotation.T.tolist(), half.tolist(), strict=True))
        return Box(middle, half, corners, float(corners[:, 2].min()), axes)

    def overhang(self, points: Array) -> float:
        """Return how far the farthest of the points (n, 3) lies outside, along its axes, in m; negative inside."""
        local = (points - self.middle.position) @ self.middle.rotation
        return float((np.abs(local) - self.half).max())

    def height_at(self, x: float, y: float) -> float | None:
        """Return the height in m of the box's top over a place on the floor, None where it is not over it."""
        top, bottom = inf, -inf
        middle_x, middle_y, middle_z = self.middle.position.tolist()
        for right, ahead, upwards, half in self.axes:
            along = right * (x - middle_x) + ahead * (y - middle_y) - upwards * middle_z
            if abs(upwards) > 1e-12:
                one, other = (-half - along) / upwards, (half - along) / upwards
                bottom, top = max(bottom, min(one, other)), min(top, max(one, other))
            elif abs(along) > half:
                return None
        return top if bottom <= top else None


def box(state: WorldState, individual: str) -> Box:
    """Return the box of a thing; a thing of which no extent is known at all is a point.

    FrameError when it is nowhere, MissingFact when a part of its extent is not known.
    """
    space = space_of(state)
    if individual not in space.boxes:
        known = any(state.value(individual, name) is not None for name in SIZE if name in state.stored)
        half = _half(space, individual) if known else np.zeros(3)
        share = next((share for cls, share in FRAME_HEIGHT.items() if state.is_a(individual, cls)), 0.0)
        middle = space.pose(individual) @ Pose.of((0.0, 0.0, -2 * share * half[2]))
        space.boxes[individual] = Box.of(middle, half)
    return space.boxes[individual]


def solid(state: WorldState, individual: str) -> Box:
    """Return the box of a thing that has an extent; errors as for `box`, MissingFact when it has none."""
    _half(space_of(state), individual)
    return box(state, individual)


def _half(space: Space, individual: str) -> Array:
    return np.array([space.number(individual, name) for name in SIZE]) / 2
