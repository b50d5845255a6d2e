"""The area of a flat surface to work on: all of it or some patches, without holes; all in the surface frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose

if TYPE_CHECKING:
    from numpy.typing import NDArray


class Hole(msgspec.Struct, frozen=True):
    """A rectangle that the tool must not touch: its centre and size (2,) in m along the axes of the surface frame.

    The area within `margin` m of it need not be worked on; planned motions keep half of that distance. It protrudes
    `height` m from the surface.
    """

    centre: Array
    size: Array
    margin: float = 0.0
    height: float = 0.0

    def grow(self, by: float) -> Hole:
        """Return the hole enlarged by `by` m on each side, without margin."""
        return Hole(self.centre, self.size + 2 * by, 0.0, self.height)

    def in_frame(self, frame: Pose) -> Hole:
        """Return the smallest rectangle along the axes of `frame`, a frame in the surface, that contains the hole."""
        axes = frame.rotation[:2, :2]
        away = axes.T @ (self.centre - frame.position[:2])
        return Hole(away, np.abs(axes.T) @ self.size, self.margin, self.height)


class Patch(msgspec.Struct, frozen=True):
    """A rectangle of a surface: the pose of its centre in the surface frame, and its size (2,) in m."""

    pose: Pose
    size: Array


class Layout(msgspec.Struct, frozen=True):
    """A surface of size (2,) in m, in its frame; only its patches are worked on, or all of it if it has none."""

    size: Array
    patches: tuple[Patch, ...] = ()
    holes: tuple[Hole, ...] = ()

    @property
    def parts(self) -> tuple[Patch, ...]:
        """The patches, or one that is the whole surface."""
        return self.patches or (Patch(Pose(np.zeros(3), np.eye(3)), self.size),)

    @property
    def height(self) -> float:
        """The height in m of the highest hole, 0 if there is none."""
        return max((hole.height for hole in self.holes), default=0.0)

    def work_mask(self, x: Array, y: Array) -> NDArray[np.bool_]:
        """Return the mask (m, n) of the points to work on in a grid of x (n,) and y (m,) in m."""
        points = np.stack(np.meshgrid(x, y), axis=-1)
        wanted = np.zeros(points.shape[:2], dtype=bool)
        for part in self.parts:
            own = (points - part.pose.position[:2]) @ part.pose.rotation[:2, :2]
            wanted |= (np.abs(own) <= part.size / 2).all(axis=-1)
        for hole in self.holes:
            near = np.abs(points - hole.centre) < hole.size / 2 + hole.margin
            wanted &= ~near.all(axis=-1)
        return wanted
