"""Overlays: motions that are added to the motion of an arm until they are halted."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.devices.motion_interface import Infeasible
from skillc_runtime.motion.overlays import Circle, Lissajous, Spiral
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.reference import Overlay
from skillc_runtime.primitives.arm_motion import infeasible_motion
from skillc_runtime.primitives.primitive import NOTHING, Primitive, SkillFailure, Status
from skillc_runtime.primitives.space_needs import SpaceNeed, ToolOffsets
from skillc_runtime.world.state.labels.labelled import LabelledQuantity

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell
    from skillc_runtime.world.state.values import Value
    from skillc_runtime.world.state.world_state import WorldState

FADE_TIME_S = 0.5
"""Time in which an overlay fades in and out."""

MIN_IN_PLANE_SHARE = 0.1
"""A direction with a smaller share than this in a plane counts as normal to it."""


class AddedMotion(Primitive):
    """A motion that is added along `axes` (3, 3) in the world frame until it is halted.

    `name` describes it in messages; `speed` is its maximum speed in m/s.
    """

    moves = NOTHING

    def __init__(self, cell: Cell, arm: str, overlay: Overlay, axes: Array, name: str, speed: float) -> None:
        super().__init__(cell)
        self.arm = cell.arm(arm)
        self._overlay, self._axes, self._handle = overlay, axes, 0
        self._name, self._speed = name, speed

    def start(self) -> None:
        """Fade in; SkillFailure if the motion is faster than the arm allows."""
        if self._speed > self.arm.task_limits.speed_m_s:
            raise SkillFailure(
                f"{self._name} runs with {{speed:.2f}}, faster than the {{limit}} the arm allows",
                speed=LabelledQuantity(self._speed, "m/s"),
                limit=LabelledQuantity(self.arm.task_limits.speed_m_s, "m/s"),
            )
        try:
            self._handle = self.arm.motion.add_overlay(self._overlay, self._axes, FADE_TIME_S)
        except Infeasible as why:
            raise infeasible_motion(self.cell, self.arm, why) from why

    def tick(self) -> Status:
        """Return RUNNING."""
        return Status.RUNNING

    def halt(self, reason: str) -> None:
        """Fade out."""
        self.arm.motion.remove_overlay(self._handle)

    def pause(self) -> None:
        """Slow down to a standstill."""
        self.arm.motion.pause()

    def resume(self) -> None:
        """Continue the motion."""
        self.arm.motion.resume()


class OverlayCircle(AddedMotion):
    """A circle in the plane with the normal `plane` (3,): `radius` m, `rate` turns per s."""

    @classmethod
    def needs_space(cls, arguments: Mapping[str, Value], state: WorldState) -> tuple[SpaceNeed, ...] | None:
        """Return that the tool is anywhere on the circle."""
        arm, plane, radius = (arguments.get(each) for each in ("arm", "plane", "radius"))
        if not isinstance(arm, str) or not isinstance(plane, np.ndarray) or not isinstance(radius, float):
            return None
        x, y, _ = axes_with_normal(plane).T
        return (ToolOffsets(arm, radius * np.array([x, y, -x, -y])),)

    def __init__(self, cell: Cell, *, arm: str, plane: Array, radius: float, rate: float) -> None:
        circle = Circle(radius, rate)
        name = f"a circle of {1000 * radius:g} mm at {rate:g} Hz"
        super().__init__(cell, arm, circle, axes_with_normal(plane), name, circle.speed)


class OverlaySine(AddedMotion):
    """A sine along `along` (3,): `amplitude` m to either side, `rate` periods per s."""

    @classmethod
    def needs_space(cls, arguments: Mapping[str, Value], state: WorldState) -> tuple[SpaceNeed, ...] | None:
        """Return that the tool is on both ends of the sine."""
        arm, along, amplitude = (arguments.get(each) for each in ("arm", "along", "amplitude"))
        if not isinstance(arm, str) or not isinstance(along, np.ndarray) or not isinstance(amplitude, float):
            return None
        return (ToolOffsets(arm, amplitude * np.array([along, -along])),)

    def __init__(self, cell: Cell, *, arm: str, along: Array, amplitude: float, rate: float) -> None:
        sine = Lissajous(np.array([0.0, 0.0, amplitude]), np.full(3, rate), np.zeros(3))
        name = f"a swing of {1000 * amplitude:g} mm at {rate:g} Hz"
        super().__init__(cell, arm, sine, axes_with_normal(along), name, 2 * pi * rate * amplitude)


class OverlaySpiral(AddedMotion):
    """A spiral in the plane with the normal `plane` (3,): turns `pitch` m apart, at `speed` m/s to `radius` m."""

    def __init__(self, cell: Cell, *, arm: str, plane: Array, pitch: float, speed: float, radius: float) -> None:
        super().__init__(cell, arm, Spiral(pitch, speed, radius), axes_with_normal(plane), "a spiral", speed)


class OverlayLissajous(AddedMotion):
    """A Lissajous figure: `width` m to either side along `along` (3,) at `rate` periods per s, and `height` m across it
    in the plane with the normal `plane` (3,) at `across_rate`; `phase` rad is that of the sine along `along`.
    """

    def __init__(  # noqa: PLR0913 - the parameters of the skill, by name
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
        super().__init__(cell, arm, figure, _axes_in_plane(plane, along), name, figure.speed)


def _axes_in_plane(plane: Array, along: Array) -> Array:
    """Return axes (3, 3): x the projection of `along` on the plane, z its normal; SkillFailure if they are parallel."""
    x = along - (along @ plane) * plane
    if np.linalg.norm(x) < MIN_IN_PLANE_SHARE * np.linalg.norm(along):
        raise SkillFailure("a figure needs a direction `along` that lies in its plane, not one across it")
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(plane, x), plane])


def axes_with_normal(normal: Array) -> Array:
    """Return axes (3, 3) whose z axis is the unit normal (3,)."""
    near = np.eye(3)[int(np.abs(normal).argmin())]
    x = np.cross(near, normal)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(normal, x), normal])
