"""Oriented boxes in the world: corners, distance of points, height of the top."""

from __future__ import annotations

from math import inf

import msgspec

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose

CORNERS = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
"""The corners (8, 3) of a box in its own frame, unitless: multiples of half its extent."""


class OrientedBox(msgspec.Struct, frozen=True, eq=False):
    """A box: pose of its middle in the world, half its extent (3,) m along its axes, corners (8, 3) m in the world.

    `lowest` is the height in m of the lowest corner in the world. `axes` are the three axes: direction in the world
    (x, y, z), unitless, and half the extent in m.
    """

    middle: Pose
    half: Array
    corners: Array
    lowest: float
    axes: tuple[tuple[float, float, float, float], ...]

    @staticmethod
    def of(middle: Pose, half: Array) -> OrientedBox:
        """Return the box with its middle at a pose in the world and half its extent (3,) m along its axes."""
        corners = CORNERS * half @ middle.rotation.T + middle.position
        axes = tuple((x, y, z, h) for (x, y, z), h in zip(middle.rotation.T.tolist(), half.tolist(), strict=True))
        return OrientedBox(middle, half, corners, float(corners[:, 2].min()), axes)

    def overhang(self, points: Array) -> float:
        """Return how far the farthest of points (n, 3) m, in the world, lies outside, in m; negative inside.

        The distance is measured along the axes of the box.
        """
        local = (points - self.middle.position) @ self.middle.rotation
        return float((np.abs(local) - self.half).max())

    def distance(self, points: Array) -> float:
        """Return how far the nearest of points (n, 3) m, in the world, is from the box, in m; 0 inside."""
        local = (points - self.middle.position) @ self.middle.rotation
        return float(np.linalg.norm(np.maximum(np.abs(local) - self.half, 0.0), axis=1).min())

    def height_at(self, x: float, y: float) -> float | None:
        """Return the height in m of the top over a point (x, y) in m, both in the world; None if it is not over it."""
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
