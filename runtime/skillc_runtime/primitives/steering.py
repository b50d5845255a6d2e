"""A search that somebody steers from outside, tick by tick, in place of a spiral."""

from __future__ import annotations

from contextvars import ContextVar
from math import exp
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.primitives.overlay import AddedMotion, axes_with_normal
from skillc_runtime.primitives.primitive import SkillFailure

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell

LAG_S = 0.05
"""The time constant with which a steered motion takes a new velocity."""

BACK_S = 0.2
"""The time constant with which a motion outside of its circle comes back to it."""


class _Piece(NamedTuple):
    """From `start` s on, the velocity goes from `before` to `wanted`, both (2,) in m/s, from an `offset` (2,) in m."""

    start: float
    offset: Array
    before: Array
    wanted: Array

    def at(self, time: float) -> Array:
        """Return offset, velocity and acceleration (3, 2): those of a first-order lag."""
        since = time - self.start
        left = exp(-since / LAG_S)
        change = self.before - self.wanted
        offset = self.offset + self.wanted * since + change * LAG_S * (1.0 - left)
        return np.array([offset, self.wanted + change * left, -change * left / LAG_S])


class SteeredOverlay:
    """A motion in the x-y plane of the overlay frame with velocities that are given while it goes on.

    What is steered changes nothing before its time, so that the motion up to there is a function of time alone.
    """

    def __init__(self, radius: float) -> None:
        """Stand still in the middle of a circle with a radius in m, which is not left."""
        zero = np.zeros(2)
        self._radius, self._piece = radius, _Piece(0.0, zero, zero, zero)

    def at(self, time: float) -> Array:
        """Return offset, velocity and acceleration (3, 3) at `time` s: m, m/s, m/s^2, in the overlay's frame."""
        motion = np.zeros((3, 3))
        motion[:, :2] = self._piece.at(max(time, self._piece.start))
        return motion

    def steer(self, time: float, velocity: Array) -> None:
        """Take another velocity (2,) in m/s from `time` s on; outside the circle it leads back to it."""
        offset, before, _ = self._piece.at(max(time, self._piece.start))
        distance = float(np.linalg.norm(offset))
        if distance > self._radius:
            outwards = max(float(velocity @ offset) / distance, 0.0)
            velocity = velocity - (outwards + (distance - self._radius) / BACK_S) * offset / distance
        self._piece = _Piece(time, offset, before, np.array(velocity, dtype=float))


class Steering:
    """Steers the search of one run; `active` is the search while it goes on."""

    def __init__(self) -> None:
        self.active: SteeredSearch | None = None


steering: ContextVar[Steering | None] = ContextVar("steering", default=None)
"""Who steers the runs that are ticked in this context."""


class SteeredSearch(AddedMotion):
    """A motion in the plane with the normal `plane` (3,) within `radius` m that is steered, at most at `speed` m/s.

    It stands in for a spiral, whose `pitch` it does not need.
    """

    def __init__(self, cell: Cell, *, arm: str, plane: Array, pitch: float, speed: float, radius: float) -> None:
        self.overlay, self.axes = SteeredOverlay(radius), axes_with_normal(plane)
        super().__init__(cell, arm, self.overlay, self.axes, "a steered search", speed)
        self.speed, self.radius, self._steering = speed, radius, steering.get()
        self._began, self._from = 0.0, np.zeros(3)

    def start(self) -> None:
        """Fade in; SkillFailure if nobody steers, or as of `AddedMotion`."""
        if self._steering is None:
            raise SkillFailure("nobody steers this search: it runs in an environment of skillc.gym")
        super().start()
        self._began, self._from = self.cell.now, self.arm.measured.pose.position
        self._steering.active = self

    def steer(self, share: Array) -> None:
        """Move on with a share (2,) of the speed along the axes of the plane; a longer one is shortened to 1."""
        velocity = self.speed * share / max(1.0, float(np.linalg.norm(share)))
        self.overlay.steer(self.cell.now - self._began, velocity)

    def observe(self) -> tuple[Array, Array, Array]:
        """Return the commanded offset (2,) in m, where the tool is (3,) in m from where it began, and the force on it.

        The force (3,) in N is that of the environment. All are along the axes of the plane, its normal last.
        """
        measured = self.arm.measured
        offset: Array = self.overlay.at(self.cell.now - self._began)[0, :2]
        moved: Array = self.axes.T @ (measured.pose.position - self._from)
        return offset, moved, self.axes.T @ measured.wrench[:3]

    def halt(self, reason: str) -> None:
        """Fade out, steered no more."""
        if self._steering is not None:
            self._steering.active = None
        super().halt(reason)
