"""Measures how the time of a reader grows with the length of its text; a machine that is busy does not matter."""

from __future__ import annotations

import gc
import time
from collections.abc import Callable, Iterator
from math import log2
from typing import NamedTuple

MOST_EXPONENT = 1.6
"""Time that grows with a greater power of the length is not linear; one that is linear is measured as .8 to 1.3."""
LEAST_S = 0.15
"""Shorter times say nothing."""
ENOUGH_S = 0.4
"""Once a text takes as long, no longer one is tried."""
FIRST, STEPS = 8, 2
"""The number of repetitions to begin with, and over how many doublings the growth is measured."""
REPEATS = 3
"""A growth that seems too great is measured as often again; the shortest time counts."""


class Growth(NamedTuple):
    """The power of the length with which time grows, and for how many repetitions it was measured."""

    exponent: float
    repetitions: int
    seconds: float


def measure_growth(read: Callable[[str], object], make: Callable[[int], str], longest: int) -> Growth:
    """Return how the time of reading grows with the repetitions of which a text is made, up to `longest` characters."""
    found = _growth(read, make, longest, range(1))
    return found if found.exponent <= MOST_EXPONENT else _growth(read, make, longest, range(1, 1 + REPEATS))


def _growth(read: Callable[[str], object], make: Callable[[int], str], longest: int, turns: range) -> Growth:
    times: list[float] = []
    count = FIRST
    for count in _doubled(make, longest):
        # Each time another text: readers remember what they have read.
        times.append(min(_seconds(read, make(count) + " " * turn) for turn in turns))
        if times[-1] > ENOUGH_S and len(times) > STEPS:
            break
    base = times[0]
    last, before = times[-1] - base, (times[-1 - STEPS] if len(times) > STEPS else base) - base
    if last < max(LEAST_S, base / 2):
        return Growth(0.0, count, times[-1])
    return Growth(log2(last / max(before, LEAST_S / 4**STEPS)) / STEPS, count, times[-1])


def _doubled(make: Callable[[int], str], longest: int) -> Iterator[int]:
    count = FIRST
    while len(make(count)) <= longest:
        yield count
        count *= 2


def _seconds(read: Callable[[str], object], text: str) -> float:
    # A collection walks all that the process holds, whatever the text; what was read is looked through afterwards.
    gc.disable()
    try:
        began = time.thread_time()
        read(text)
        return time.thread_time() - began
    finally:
        gc.enable()
