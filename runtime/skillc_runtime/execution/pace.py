"""The pace of a cell: how fast its time may pass compared with the clock on the wall."""

from __future__ import annotations

import time
from collections.abc import Callable
from math import inf

FAST, REAL = inf, 1.0
SLOWEST = 0.01
"""The least pace: a tick of 10 ms takes a second, so that what takes effect in the next one does so soon."""
PACES = (0.1, 0.25, 0.5, REAL, 2.0, 4.0, 8.0, FAST)
"""The paces between which a user changes."""

MAX_LAG_S = 0.1
"""How far a cell may be behind its pace, in s of wall time, and catch up; what is lost beyond that stays lost."""


class Pace:
    """Limits the ratio of the cell's time to wall time to `factor`, at any time; FAST is no limit.

    After a time in which the cell could not keep up, or stood still, it does not rush. `is_fixed`: the cell has a time
    of its own, and a user changes nothing.
    """

    def __init__(self, factor: float = FAST, wall_clock: Callable[[], float] = time.monotonic) -> None:
        """Start with a factor; `wall_clock` returns the wall time in s."""
        self.factor, self.is_fixed = factor, False
        self._wall_clock = wall_clock
        self._at = 0.0
        self._due = -inf

    def remaining_s(self, now: float, standing: bool = False) -> float:
        """Return how long, in s of wall time, the tick at the time `now` of the cell in s is not due yet; 0 if it is.

        While the cell is `standing`, because all is paused, its pace is at most real time.
        """
        factor = min(self.factor, REAL) if standing else self.factor
        self._due += max(0.0, now - self._at) / factor
        self._at = now
        wall = self._wall_clock()
        self._due = max(self._due, wall - MAX_LAG_S)
        return 0.0 if factor == FAST else max(0.0, self._due - wall)

    def change(self, factor: float) -> None:
        """Change the factor; the next tick is due now."""
        self.factor, self._due = factor, -inf

    def fix(self) -> None:
        """Let it be real time from now on, that of devices."""
        self.change(REAL)
        self.is_fixed = True

    def faster(self) -> None:
        """Change to the next greater one of PACES."""
        self.change(next((pace for pace in PACES if pace > self.factor), FAST))

    def slower(self) -> None:
        """Change to the next smaller one of PACES."""
        self.change(next((pace for pace in reversed(PACES) if pace < self.factor), self.factor))


def parse_pace(pace: float | str) -> float:
    """Return the factor that `fast`, `real` or a number means; ValueError with the form to write otherwise."""
    text = pace if isinstance(pace, str) else "fast" if pace == FAST else str(pace)
    named = {"fast": FAST, "real": REAL}
    if text in named:
        return named[text]
    try:
        factor = float(text)
    except ValueError:
        factor = 0.0
    if not SLOWEST <= factor < inf:
        form = f"write `fast`, `real`, or a factor from {SLOWEST:g}, such as `0.5` for half of real time"
        raise ValueError(f"`{text}` is no pace; {form}")
    return factor


def format_pace(factor: float) -> str:
    """Return a factor as it is written."""
    return {FAST: "fast", REAL: "real"}.get(factor) or f"{factor:g}"
