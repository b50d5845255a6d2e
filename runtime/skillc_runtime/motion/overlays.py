"""Motions that are added to the motion of the tool: periodic or growing figures in a plane, faded in and out.

The axes of an overlay are those that are passed to `ReferenceGenerator.add`, which gives them in the base frame.
"""

from __future__ import annotations

from math import asinh, cos, inf, pi, sin, sqrt

import msgspec
import numpy as np
from msgspec.structs import replace

from skillc_runtime.motion.arrays import OutMatrix, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.reference import Overlay

CIRCLE, SINES, GIVEN, SPIRAL = 1.0, 2.0, 3.0, 4.0
"""Kinds of overlays that `reference_plan` samples; it is given the samples of all others."""


@compiled
def circle_at(motion: OutMatrix, radius: float, rate: float, time: float) -> None:
    """Compute a circle, along the axes of the overlay.

    motion: (3, 3) in m, m/s, m/s^2: offset, velocity and acceleration in the frame of the overlay; it is written.
    radius: m.
    rate: turns per s.
    time: s.
    """
    w = 2 * pi * rate
    x, y = radius * cos(w * time), radius * sin(w * time)
    motion[0, 0], motion[0, 1] = x, y
    motion[1, 0], motion[1, 1] = -w * y, w * x
    motion[2, 0], motion[2, 1] = -w * w * x, -w * w * y


@compiled
def sines_at(motion: OutMatrix, amplitude: Vector, frequency: Vector, phase: Vector, time: float) -> None:
    """Compute a sine along each of the axes of the overlay.

    motion: (3, 3) in m, m/s, m/s^2: offset, velocity and acceleration in the frame of the overlay; it is written.
    amplitude: (3,) in m.
    frequency: (3,) in Hz.
    phase: (3,) in rad.
    time: s.
    """
    for i in range(3):
        w = 2 * pi * frequency[i]
        angle = w * time + phase[i]
        motion[0, i] = amplitude[i] * sin(angle)
        motion[1, i] = amplitude[i] * w * cos(angle)
        motion[2, i] = -w * w * motion[0, i]


@inlined
def _arc(theta: float) -> float:
    """Return the length of the unit spiral r = theta up to `theta` rad."""
    return (theta * sqrt(1 + theta * theta) + asinh(theta)) / 2


@inlined
def _angle_at(length: float) -> float:
    """Return the angle in rad at which the unit spiral has a given length, by Newton's method from above the root."""
    theta = min(length, sqrt(2 * length))
    for _ in range(8):
        theta -= (_arc(theta) - length) / sqrt(1 + theta * theta)
    return theta


@compiled
def spiral_at(motion: OutMatrix, pitch: float, speed: float, radius: float, time: float) -> None:
    """Compute a spiral, along the axes of the overlay.

    r = b theta in the x-y plane, b = pitch / 2 pi, at constant speed; from `radius` on it is a circle.
    motion: (3, 3) in m, m/s, m/s^2: offset, velocity and acceleration in the frame of the overlay; it is written.
    pitch: m between turns.
    speed: m/s.
    radius: m.
    time: s.
    """
    b = pitch / (2 * pi)
    widest = radius / b
    rounded = (time - b * _arc(widest) / speed) * speed
    if rounded > 0.0:
        theta = widest + rounded / radius
        c, s = cos(theta), sin(theta)
        bend = speed * speed / radius
        motion[0, 0], motion[0, 1] = radius * c, radius * s
        motion[1, 0], motion[1, 1] = -speed * s, speed * c
        motion[2, 0], motion[2, 1] = -bend * c, -bend * s
        return
    theta = _angle_at(max(speed * time, 0.0) / b)
    c, s = cos(theta), sin(theta)
    first = speed / (b * sqrt(1 + theta * theta))
    second = -theta * first * first / (1 + theta * theta)
    inward = b * (second - theta * first * first)
    around = b * (second * theta + 2 * first * first)
    motion[0, 0], motion[0, 1] = b * theta * c, b * theta * s
    motion[1, 0], motion[1, 1] = b * first * (c - theta * s), b * first * (s + theta * c)
    motion[2, 0], motion[2, 1] = inward * c - around * s, inward * s + around * c


class Circle(msgspec.Struct, frozen=True):
    """A circle in the x-y plane of the overlay frame: radius in m, rate in turns per s."""

    radius: float
    rate: float

    @property
    def speed(self) -> float:
        """The speed along the circle in m/s."""
        return 2 * pi * self.radius * self.rate

    @property
    def numbers(self) -> tuple[float, ...]:
        """The kind of overlay, and what describes it, for `reference_plan`: radius in m, turns per s."""
        return CIRCLE, self.radius, self.rate

    def at(self, time: float) -> Array:
        """Return offset, velocity and acceleration (3, 3) at `time` s: m, m/s, m/s^2."""
        motion = np.zeros((3, 3))
        circle_at(motion, self.radius, self.rate, time)
        return motion


class Lissajous(msgspec.Struct, frozen=True):
    """A sine along each axis of the overlay frame: amplitude (3,) m, frequency (3,) Hz, phase (3,) rad."""

    amplitude: Array
    frequency: Array
    phase: Array

    @property
    def speed(self) -> float:
        """An upper bound of the speed in m/s, reached if all axes are fastest at the same time."""
        return float(np.linalg.norm(2 * pi * self.frequency * self.amplitude))

    @property
    def numbers(self) -> tuple[float, ...]:
        """The kind of overlay, and what describes it, for `reference_plan`: all amplitudes in m, Hz, rad."""
        return SINES, *self.amplitude, *self.frequency, *self.phase

    def at(self, time: float) -> Array:
        """Return offset, velocity and acceleration (3, 3) at `time` s: m, m/s, m/s^2."""
        motion = np.empty((3, 3))
        sines_at(motion, self.amplitude, self.frequency, self.phase, time)
        return motion


class Spiral(msgspec.Struct, frozen=True):
    """An Archimedean spiral in the x-y plane of the overlay frame, at constant speed; it ends in a circle.

    pitch: m between turns; speed: m/s; radius: m, of the circle.
    """

    pitch: float
    speed: float
    radius: float

    @property
    def numbers(self) -> tuple[float, ...]:
        """The kind of overlay, and what describes it, for `reference_plan`: pitch in m, speed in m/s, radius in m."""
        return SPIRAL, self.pitch, self.speed, self.radius

    def at(self, time: float) -> Array:
        """Return offset, velocity and acceleration (3, 3) at `time` s: m, m/s, m/s^2."""
        motion = np.zeros((3, 3))
        spiral_at(motion, self.pitch, self.speed, self.radius, time)
        return motion


class FadedOverlay(msgspec.Struct, frozen=True):
    """An overlay that fades in for `fade` s from `start` on, and out for as long from `end` on; times in s.

    Its frame is that of the overlay.
    """

    overlay: Overlay
    start: float
    fade: float
    end: float | None = None

    def end_at(self, time: float) -> FadedOverlay:
        """Return this overlay with its end at `time`, or unchanged if it has an end already."""
        return self if self.end is not None else replace(self, end=time)

    def is_over(self, time: float) -> bool:
        """Tell whether it has faded out at `time`."""
        return self.end is not None and time >= self.end + self.fade

    def at(self, time: float) -> Array:
        """Return offset, velocity and acceleration (3, 3) at `time`: m, m/s, m/s^2.

        By the product rule, applied twice.
        """
        motion = np.array(self.overlay.at(time - self.start), dtype=float)
        faded_at(motion, self.start, self.fade, inf if self.end is None else self.end, time)
        return motion


@inlined
def _rise(x: float, fade: float) -> tuple[float, float, float]:
    """Return the quintic step 10 x^3 - 15 x^4 + 6 x^5 on [0, 1] and its first two derivatives by time, x = t / fade."""
    if x <= 0:
        return 0.0, 0.0, 0.0
    if x >= 1:
        return 1.0, 0.0, 0.0
    slope, bend = 30 * x * x * (1 - x) ** 2, 60 * x * (1 - x) * (1 - 2 * x)
    return x**3 * (10 - 15 * x + 6 * x * x), slope / fade, bend / fade**2


@compiled
def faded_at(motion: OutMatrix, start: float, fade: float, end: float, time: float) -> None:
    """Fade a motion in and out, by the product rule.

    motion: (3, 3) in m, m/s, m/s^2: offset, velocity and acceleration in the frame of the overlay; it is changed.
    start: s, from when it fades in.
    fade: s, how long it fades in, and out.
    end: s, from when it fades out.
    time: s.
    """
    g, dg, ddg = _rise((time - start) / fade, fade)
    if end < inf:
        f, df, ddf = _rise((end + fade - time) / fade, -fade)
        g, dg, ddg = g * f, dg * f + g * df, ddg * f + 2 * dg * df + g * ddf
    if g == 1.0:
        return
    for i in range(3):
        offset, velocity, acceleration = motion[0, i], motion[1, i], motion[2, i]
        motion[0, i] = g * offset
        motion[1, i] = dg * offset + g * velocity
        motion[2, i] = ddg * offset + 2 * dg * velocity + g * acceleration
