"""The time of a motion, which can be slowed to a standstill and taken up again without a jump in speed."""

from __future__ import annotations

from dataclasses import dataclass

RAMP_S = 0.5
"""Seconds from full speed to standstill."""


@dataclass(frozen=True, slots=True)
class TimeScaling:
    """From `since` on, when motion time was `time` and ran at `rate`, the rate changes evenly to `goal`, 0 or 1."""

    since: float = 0.0
    time: float = 0.0
    rate: float = 1.0
    goal: float = 1.0

    def at(self, now: float) -> tuple[float, float, float]:
        """Return motion time in s, its rate, and the rate's change per s."""
        passed = now - self.since
        if self.rate == self.goal:
            return self.time + self.goal * passed, self.goal, 0.0
        ramp = abs(self.goal - self.rate) * RAMP_S
        slope = (self.goal - self.rate) / ramp
        if passed >= ramp:
            return self.time + (self.rate + self.goal) / 2 * ramp + self.goal * (passed - ramp), self.goal, 0.0
        return self.time + self.rate * passed + slope * passed * passed / 2, self.rate + slope * passed, slope

    def towards(self, goal: float, now: float) -> TimeScaling:
        """Return the scaling that from now on changes to `goal`."""
        time, rate, _ = self.at(now)
        return TimeScaling(now, time, rate, goal)
