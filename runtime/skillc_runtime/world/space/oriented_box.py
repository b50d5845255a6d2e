"""A box in the world: its corners, what it contains, and how high its top is."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np

from skillc_runtime.motion.pose import Array, Pose

CORNERS = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])


@dataclass(frozen=True, slots=True, eq=False)
class OrientedBox:
    """A box: its middle in the world, half its extent (3,) m along its axes, its corners (8, 3) in the world.

    `lowest` is the height in m of the lowest corner, `axes` are its axes in the world, each with half the extent.
    """

    middle: Pose
    half: Array
    corners: Array
    lowest: float
    axes: tuple[tuple[float, float, float, float], ...]

    @staticmethod
    def of(middle: Pose, half: Array) -> OrientedBox:
        """Return the box with its middle at a pose and half its extent (3,) m."""
        corners = CORNERS * half @ middle.rotation.T + middle.position
        axes = tuple((x, y, z, h) for (x, y, z), h in zip(middle.rotation.T.tolist(), half.tolist(), strict=True))
        return OrientedBox(middle, half, corners, float(corners[:, 2].min()), axes)

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
