"""How far apart the ticks of a cell are: whether what clients ask for holds them up."""

from __future__ import annotations

import time
from bisect import bisect_left
from collections.abc import Callable

BOUNDS_S = (0.001, 0.0025, 0.005, 0.01, 0.0125, 0.015, 0.02, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0)
"""The upper bounds of the counted intervals, in s of wall time; one more count is for longer ones."""


class TickIntervals:
    """Counts the intervals between the beginnings of successive ticks, by BOUNDS_S.

    After `pause` the interval up to the next tick does not count.
    """

    def __init__(self, wall_clock: Callable[[], float] = time.monotonic) -> None:
        """`wall_clock` returns the wall time in s."""
        self.sum_s = 0.0
        self._counts = [0] * (len(BOUNDS_S) + 1)
        self._wall_clock = wall_clock
        self._last: float | None = None

    @property
    def counts(self) -> tuple[int, ...]:
        """How many intervals there were up to each bound but above the one before, then the longer ones."""
        return tuple(self._counts)

    def begin_tick(self) -> None:
        """A tick begins now."""
        now = self._wall_clock()
        if self._last is not None:
            self.sum_s += now - self._last
            self._counts[bisect_left(BOUNDS_S, now - self._last)] += 1
        self._last = now

    def pause(self) -> None:
        """The next tick is not one that follows the last one at once."""
        self._last = None
