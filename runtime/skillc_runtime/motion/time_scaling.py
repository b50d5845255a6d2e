"""The time of a motion, which can be slowed to a standstill and resumed without a jump in speed."""

from __future__ import annotations

import msgspec

from skillc_runtime.motion.numerics.compiled import compiled

RAMP_S = 0.5
"""Least time from full speed to standstill."""


class TimeScaling(msgspec.Struct, frozen=True):
    """A change of the rate of motion time, linear in time, from `rate` to `goal`, each from 0 to 1.

    It begins at `since` s, when motion time is `time` s, and would take `ramp_s` s between standstill and full speed.
    Times `now` are in s.
    """

    since: float = 0.0
    time: float = 0.0
    rate: float = 1.0
    goal: float = 1.0
    ramp_s: float = RAMP_S

    def at(self, now: float) -> tuple[float, float, float]:
        """Return motion time in s, its rate, and the change of the rate in 1/s."""
        return scaled_time(self.since, self.time, self.rate, self.goal, self.ramp_s, now)

    @property
    def numbers(self) -> tuple[float, float, float, float, float]:
        """What `scaled_time` takes: s, s, two rates, s."""
        return self.since, self.time, self.rate, self.goal, self.ramp_s

    def towards(self, goal: float, now: float, ramp_s: float = RAMP_S) -> TimeScaling:
        """Return the scaling whose rate changes to a goal from now on.

        goal: 0 to 1, a factor of the time.
        now: s.
        ramp_s: s, between standstill and full speed.
        """
        time, rate, _ = self.at(now)
        return TimeScaling(now, time, rate, goal, ramp_s)


def start_time(now: float, rate: float) -> TimeScaling:
    """Return motion time that is 0 at the time `now` in s, and has a rate."""
    return TimeScaling(since=now, rate=rate, goal=rate)


@compiled
def scaled_time(
    since: float, time: float, rate: float, goal: float, ramp_s: float, now: float
) -> tuple[float, float, float]:
    """Return motion time in s, its rate, and the change of the rate in 1/s, of a `TimeScaling`.

    since: s, when it begins.
    time: s, the motion time then.
    rate: 0 to 1, the factor of the time then.
    goal: 0 to 1, the factor of the time in the end.
    ramp_s: s, between standstill and full speed.
    now: s.
    """
    passed = now - since
    if rate == goal:
        return time + goal * passed, goal, 0.0
    ramp = abs(goal - rate) * ramp_s
    slope = (goal - rate) / ramp
    if passed >= ramp:
        return time + (rate + goal) / 2 * ramp + goal * (passed - ramp), goal, 0.0
    return time + rate * passed + slope * passed * passed / 2, rate + slope * passed, slope
