"""Motions that are added to whatever the arm does, until halted."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.overlays import Circle
from skillc_runtime.motion.pose import Array
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status

if TYPE_CHECKING:
    from skillc_runtime.robots.cell import Cell

FADE_S = 0.5


class OverlayCircle(Primitive):
    """Circle in the plane with the normal `plane` (3,): `radius` m, `rate` turns per s. Runs until it is halted."""

    def __init__(self, cell: Cell, *, arm: str, plane: Array, radius: float, rate: float) -> None:
        super().__init__(cell)
        self.arm = cell.arm(arm)
        self._plane, self._circle = plane, Circle(radius, rate)
        self._handle = 0

    def start(self) -> None:
        """Begin, growing from nothing; SkillFailure where the circle is faster than the arm allows."""
        if self._circle.speed > self.arm.gains.speed_limit:
            raise SkillFailure(
                f"a circle of {1000 * self._circle.radius:g} mm at {self._circle.rate:g} Hz runs with "
                f"{self._circle.speed:.2f} m/s, faster than the {self.arm.gains.speed_limit:g} m/s the arm allows"
            )
        self._handle = self.arm.add_overlay(self._circle, axes_across(self._plane), FADE_S)

    def tick(self) -> Status:
        """Go on."""
        return Status.RUNNING

    def halt(self, reason: str) -> None:
        """Fade out."""
        self.arm.remove_overlay(self._handle)


def axes_across(normal: Array) -> Array:
    """Return axes (3, 3) whose z is the unit normal."""
    near = np.eye(3)[int(np.abs(normal).argmin())]
    x = np.cross(near, normal)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(normal, x), normal])
