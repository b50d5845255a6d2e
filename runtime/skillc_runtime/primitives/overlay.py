"""Motions that are added to whatever the arm does, until halted."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.devices.arm_driver import Infeasible
from skillc_runtime.motion.overlays import Circle, Lissajous, Spiral
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.reference import Overlay
from skillc_runtime.primitives.arm_motion import unfit
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell

FADE_S = 0.5
"""In which an overlay grows, and fades."""

ACROSS = 0.1
"""A direction of which so little lies in a plane is across it."""


class AddedMotion(Primitive):
    """A motion that is added along `axes` (3, 3) of the world and runs until it is halted.

    `name` says what it is, `speed` m/s how fast at most.
    """

    def __init__(self, cell: Cell, arm: str, overlay: Overlay, axes: Array, name: str, speed: float) -> None:
        super().__init__(cell)
        self.arm = cell.arm(arm)
        self._overlay, self._axes, self._handle = overlay, axes, 0
        self._name, self._speed = name, speed

    def start(self) -> None:
        """Begin, growing from nothing; SkillFailure where the motion is faster than the arm allows."""
        if self._speed > self.arm.task_limits.speed_m_s:
            raise SkillFailure(
                f"{self._name} runs with {self._speed:.2f} m/s, "
                f"faster than the {self.arm.task_limits.speed_m_s:g} m/s the arm allows"
            )
        try:
            self._handle = self.arm.motion.add_overlay(self._overlay, self._axes, FADE_S)
        except Infeasible as why:
            raise unfit(self.cell, self.arm, why) from why

    def tick(self) -> Status:
        """Go on."""
        return Status.RUNNING

    def halt(self, reason: str) -> None:
        """Fade out."""
        self.arm.motion.remove_overlay(self._handle)


class OverlayCircle(AddedMotion):
    """Circle in the plane with the normal `plane` (3,): `radius` m, `rate` turns per s."""

    def __init__(self, cell: Cell, *, arm: str, plane: Array, radius: float, rate: float) -> None:
        circle = Circle(radius, rate)
        name = f"a circle of {1000 * radius:g} mm at {rate:g} Hz"
        super().__init__(cell, arm, circle, axes_across(plane), name, circle.speed)


class OverlaySine(AddedMotion):
    """Swing along `along` (3,): `amplitude` m to either side, `rate` times per s."""

    def __init__(self, cell: Cell, *, arm: str, along: Array, amplitude: float, rate: float) -> None:
        sine = Lissajous(np.array([0.0, 0.0, amplitude]), np.full(3, rate), np.zeros(3))
        name = f"a swing of {1000 * amplitude:g} mm at {rate:g} Hz"
        super().__init__(cell, arm, sine, axes_across(along), name, 2 * pi * rate * amplitude)


class OverlaySpiral(AddedMotion):
    """Spiral outwards in the plane with the normal `plane` (3,): turns `pitch` m apart, `speed` m/s, to `radius` m."""

    def __init__(self, cell: Cell, *, arm: str, plane: Array, pitch: float, speed: float, radius: float) -> None:
        super().__init__(cell, arm, Spiral(pitch, speed, radius), axes_across(plane), "a spiral", speed)


class OverlayLissajous(AddedMotion):
    """Swing `width` m to either side along `along` (3,), `height` m across it in the plane, each at its own rate per s.

    `phase` rad is how far the swing along `along` is ahead at the start.
    """

    def __init__(
        self,
        cell: Cell,
        *,
        arm: str,
        plane: Array,
        along: Array,
        width: float,
        height: float,
        rate: float,
        across_rate: float,
        phase: float,
    ) -> None:
        figure = Lissajous(np.array([width, height, 0.0]), np.array([rate, across_rate, 0.0]), np.array([phase, 0, 0]))
        name = f"a figure of {1000 * width:g} mm at {rate:g} Hz by {1000 * height:g} mm at {across_rate:g} Hz"
        super().__init__(cell, arm, figure, _axes_along(plane, along), name, figure.speed)


def _axes_along(plane: Array, along: Array) -> Array:
    """Return axes (3, 3): x along a direction as it lies in the plane, z the plane's normal; SkillFailure for none."""
    x = along - (along @ plane) * plane
    if np.linalg.norm(x) < ACROSS * np.linalg.norm(along):
        raise SkillFailure("a figure needs a direction `along` that lies in its plane, not one across it")
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(plane, x), plane])


def axes_across(normal: Array) -> Array:
    """Return axes (3, 3) whose z is the unit normal."""
    near = np.eye(3)[int(np.abs(normal).argmin())]
    x = np.cross(near, normal)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(normal, x), normal])
