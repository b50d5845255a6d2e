"""Waits for the next period where no device clocks the loop, and counts time in periods."""

from __future__ import annotations

from time import monotonic, sleep

SPIN_S = 2e-4
"""The last part of a wait is spent looking at the clock: a sleeping process is woken up later than it asks for."""


class Pacer:
    """Lets a loop run once a period, in s, by the clock of the machine; what is late is not caught up with."""

    def __init__(self, period_s: float) -> None:
        self._period, self._due = period_s, monotonic()

    def wait(self) -> None:
        """Return when the next period begins."""
        now = monotonic()
        self._due = max(self._due + self._period, now)
        if (left := self._due - now - SPIN_S) > 0.0:
            sleep(left)
        while monotonic() < self._due:
            pass


class CycleClock:
    """The time of a loop in s, which grows by whole periods, and what it has missed.

    now_s: time since the first cycle. lost: cycles that were missed. late_s: by how much the last one was late.
    """

    def __init__(self, period_s: float) -> None:
        self._period, self._stamp, self._seen = period_s, float("nan"), float("nan")
        self.now_s, self.lost, self.late_s = 0.0, 0, 0.0

    def advance(self, stamp_s: float, seen_s: float) -> None:
        """Begin a cycle with a state stamped `stamp_s` by the device, at `seen_s` of the machine's clock."""
        waited, passed = seen_s - self._seen, stamp_s - self._stamp
        self._stamp, self._seen = stamp_s, seen_s
        if not waited >= 0.0:
            return
        self.late_s = waited - self._period
        measured = passed if passed > 0.0 else waited
        periods = max(1, round(measured / self._period))
        self.lost += periods - 1 + (passed == 0.0)
        self.now_s += periods * self._period
