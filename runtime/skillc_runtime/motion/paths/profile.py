"""The trapezoidal velocity profile: a motion from rest to rest over a given length, as a pure function of time."""

from __future__ import annotations

from math import sqrt

import msgspec
from msgspec.structs import replace

from skillc_runtime.motion.numerics.compiled import compiled


class Profile(msgspec.Struct, frozen=True):
    """Accelerate, cruise, decelerate over a `length` in m or rad.

    peak: speed, m/s or rad/s; acceleration, deceleration: m/s^2 or rad/s^2. rate: factor of time, below 1 for a slower
    motion.
    """

    length: float
    peak: float
    acceleration: float
    deceleration: float
    rate: float = 1.0

    @property
    def rise(self) -> float:
        """The acceleration time in s."""
        return self.peak / self.acceleration / self.rate if self.length > 0 else 0.0

    @property
    def fall(self) -> float:
        """The deceleration time in s."""
        return self.peak / self.deceleration / self.rate if self.length > 0 else 0.0

    @property
    def duration(self) -> float:
        """The time in s from rest to rest; 0 if the length is 0."""
        if self.length <= 0:
            return 0.0
        return (self.length / self.peak + self.peak / 2 * (1 / self.acceleration + 1 / self.deceleration)) / self.rate

    def at(self, time: float) -> tuple[float, float, float]:
        """Return distance, speed and acceleration at `time` s: 0 before the start, `length` after the end."""
        return trapezoid_at(self.length, self.peak, self.acceleration, self.deceleration, self.rate, time)

    @property
    def coefficients(self) -> tuple[float, float, float, float, float, float]:
        """Length, peak speed, acceleration, deceleration, rate, and a window of 0 s: what `smooth_at` takes."""
        return self.length, self.peak, self.acceleration, self.deceleration, self.rate, 0.0

    def stretch_to(self, duration: float) -> Profile:
        """Return this profile slowed down to take `duration` s, at least its own duration."""
        return self if self.length <= 0 else replace(self, rate=self.rate * self.duration / duration)


@compiled
def trapezoid_at(
    length: float, peak: float, acceleration: float, deceleration: float, rate: float, time: float
) -> tuple[float, float, float]:
    """Return distance, speed and acceleration of a `Profile`, in its units: m or rad, and s.

    length: m or rad.
    peak: m/s or rad/s, the greatest speed.
    acceleration: m/s^2 or rad/s^2.
    deceleration: m/s^2 or rad/s^2.
    rate: factor of the time, no unit, see `Profile`.
    time: s.
    """
    if time <= 0 or length <= 0:
        return 0.0, 0.0, 0.0
    k, a, d = rate, acceleration, deceleration
    left = (length / peak + peak / 2 * (1 / a + 1 / d)) / k - time
    if left <= 0:
        return length, 0.0, 0.0
    if time < peak / a / k:
        return a * (k * time) ** 2 / 2, k * a * k * time, k * k * a
    if left < peak / d / k:
        return length - d * (k * left) ** 2 / 2, k * d * k * left, -k * k * d
    return peak * (k * time - peak / a / 2), k * peak, 0.0


def trapezoidal_profile(length: float, speed: float, acceleration: float, deceleration: float | None = None) -> Profile:
    """Return the fastest profile over a length. It cruises at `speed`, or slower if the length is too short.

    Raises ValueError if one of them is not positive.
    length: >= 0 m or rad.
    speed: m/s or rad/s.
    acceleration: above 0, m/s^2 or rad/s^2.
    deceleration: above 0, m/s^2 or rad/s^2; without it that of the acceleration.
    """
    if length < 0 or min(speed, acceleration, deceleration or acceleration) <= 0:
        raise ValueError(f"a profile needs length >= 0, speed and accelerations > 0: {length}, {speed}, {acceleration}")
    a, d = acceleration, deceleration or acceleration
    return Profile(length, min(speed, sqrt(2 * length * a * d / (a + d))), a, d)
