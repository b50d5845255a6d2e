"""What of a flat surface is to be worked on: all of it or some patches, without holes; all in the surface frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.pose import Array, Pose


@dataclass(frozen=True, slots=True)
class Hole:
    """A rectangle that the tool must not touch: its middle (2,) and size (2,) in m, along the surface's axes.

    Nearer than `margin` m to it nothing need be worked on; half of that is what a planned motion keeps away. It stands
    `height` m out of the surface.
    """

    middle: Array
    size: Array
    margin: float = 0.0
    height: float = 0.0

    def grow(self, by: float) -> Hole:
        """Return the hole with a rim of `by` m around it, and no margin."""
        return Hole(self.middle, self.size + 2 * by, 0.0, self.height)

    def in_frame(self, frame: Pose) -> Hole:
        """Return the least rectangle along the axes of `frame`, a frame in the surface, that has the hole in it."""
        axes = frame.rotation[:2, :2]
        away = axes.T @ (self.middle - frame.position[:2])
        return Hole(away, np.abs(axes.T) @ self.size, self.margin, self.height)


@dataclass(frozen=True, slots=True)
class Patch:
    """A rectangle of a surface: its middle, with its axes, in the surface frame, and its size (2,) in m."""

    pose: Pose
    size: Array


@dataclass(frozen=True, slots=True)
class Layout:
    """A surface of a size (2,) in m; without patches all of it is to be worked on, otherwise those alone."""

    size: Array
    patches: tuple[Patch, ...] = ()
    holes: tuple[Hole, ...] = ()

    @property
    def parts(self) -> tuple[Patch, ...]:
        """The patches; without any the whole surface."""
        return self.patches or (Patch(Pose(np.zeros(3), np.eye(3)), self.size),)

    @property
    def height(self) -> float:
        """How far anything stands out of the surface, in m."""
        return max((hole.height for hole in self.holes), default=0.0)

    def work_mask(self, x: Array, y: Array) -> NDArray[np.bool_]:
        """Tell which points of a grid, x (n,) and y (m,) in m, are to be worked on: (m, n)."""
        points = np.stack(np.meshgrid(x, y), axis=-1)
        wanted = np.zeros(points.shape[:2], dtype=bool)
        for part in self.parts:
            own = (points - part.pose.position[:2]) @ part.pose.rotation[:2, :2]
            wanted |= (np.abs(own) <= part.size / 2).all(axis=-1)
        for hole in self.holes:
            near = np.abs(points - hole.middle) < hole.size / 2 + hole.margin
            wanted &= ~near.all(axis=-1)
        return wanted
