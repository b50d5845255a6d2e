"""A profile with limited jerk: the trapezoidal profile, averaged over a window of time.

s_w(t) = 1/w int_(t-w)^t s;  v_w = (s(t) - s(t-w)) / w;  a_w = (v(t) - v(t-w)) / w;  jerk <= 2 a / w.
"""

from __future__ import annotations

from math import isinf

import msgspec

from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.paths.profile import Profile, trapezoid_at


class SmoothProfile(msgspec.Struct, frozen=True):
    """A profile averaged over a window in s, which makes it longer by as much; speed and acceleration do not increase.

    Rise and fall are half of the duration each if it does not cruise.
    """

    profile: Profile
    window: float

    @property
    def length(self) -> float:
        """The length in m or rad."""
        return self.profile.length

    @property
    def rise(self) -> float:
        """The acceleration time in s."""
        return min(self.profile.rise + self.window, self.duration / 2) if self.length > 0 else 0.0

    @property
    def fall(self) -> float:
        """The deceleration time in s."""
        return min(self.profile.fall + self.window, self.duration / 2) if self.length > 0 else 0.0

    @property
    def duration(self) -> float:
        """The time in s from rest to rest; 0 if the length is 0."""
        return self.profile.duration + self.window if self.length > 0 else 0.0

    def at(self, time: float) -> tuple[float, float, float]:
        """Return distance, speed and acceleration at `time` s, in m or rad."""
        return smooth_at(*self.coefficients, time)

    @property
    def coefficients(self) -> tuple[float, float, float, float, float, float]:
        """Length, peak speed, acceleration, deceleration, rate and window, in m or rad and s, for `smooth_at`."""
        return (*self.profile.coefficients[:5], self.window)


@inlined
def _area(speed: float, rise: float, fall: float, length: float, end: float, time: float) -> float:
    """Return the integral of the distance until `time` s, for a profile that cruises with `speed` and ends at `end` s.

    It accelerates for `rise` s and decelerates for `fall` s.
    """
    if time <= 0:
        return 0.0
    if time < rise:
        return speed / rise * time**3 / 6
    cruised = min(time, end - fall) - rise
    cruising = speed * (rise * rise / 6 + rise * cruised / 2 + cruised * cruised / 2)
    if time <= end - fall:
        return cruising
    left = max(end - time, 0.0)
    braked = length * (fall - left) - speed / fall * (fall**3 - left**3) / 6
    return cruising + braked + length * max(time - end, 0.0)


@compiled
def smooth_at(
    length: float, peak: float, acceleration: float, deceleration: float, rate: float, window: float, time: float
) -> tuple[float, float, float]:
    """Return distance, speed and acceleration of a `SmoothProfile`. With a window of 0 s those of the profile.

    length: m or rad.
    peak: m/s or rad/s, the greatest speed.
    acceleration: m/s^2 or rad/s^2.
    deceleration: m/s^2 or rad/s^2.
    rate: factor of the time, no unit, see `Profile`.
    window: s.
    time: s.
    """
    now = trapezoid_at(length, peak, acceleration, deceleration, rate, time)
    if window == 0.0 or length <= 0.0:
        return now
    speed, rise, fall = rate * peak, peak / acceleration / rate, peak / deceleration / rate
    end = (length / peak + peak / 2 * (1 / acceleration + 1 / deceleration)) / rate
    if time >= end + window:
        return length, 0.0, 0.0
    before = trapezoid_at(length, peak, acceleration, deceleration, rate, time - window)
    way = _area(speed, rise, fall, length, end, time) - _area(speed, rise, fall, length, end, time - window)
    return way / window, (now[0] - before[0]) / window, (now[1] - before[1]) / window


def smooth_profile(profile: Profile, window: float) -> Profile | SmoothProfile:
    """Return the profile averaged over `window` s >= 0."""
    return SmoothProfile(profile, window) if window > 0 and profile.length > 0 else profile


def window_for(acceleration: float, jerk: float) -> float:
    """Return the window in s that keeps the jerk below a limit > 0; ValueError for another one.

    acceleration: m/s^2; jerk: m/s^3; or both of angles in rad.
    """
    if jerk <= 0:
        raise ValueError(f"a jerk must be above 0, not {jerk:g}")
    return 0.0 if isinf(jerk) else 2 * acceleration / jerk
