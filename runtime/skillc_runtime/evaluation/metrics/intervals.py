"""Intervals of time, and what is left of them without pauses."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TypeAlias

from skillc_runtime.motion.time_scaling import RAMP_S

Interval: TypeAlias = tuple[float, float]
"""Start and end in s of the cell's clock."""


def subtract_intervals(intervals: Iterable[Interval], removed: Iterable[Interval]) -> tuple[Interval, ...]:
    """Return the parts of intervals that are in none of the removed ones, in order."""
    left = tuple(intervals)
    for gap in removed:
        left = tuple(part for each in left for part in _subtract(each, gap))
    return left


def exclude_pauses(intervals: Iterable[Interval], pauses: Iterable[Interval]) -> tuple[Interval, ...]:
    """Return the parts of intervals in which motions run as planned: without pauses, nor the ramps around them.

    A pause is the interval between the events `Paused` and `Resumed`.
    """
    return subtract_intervals(intervals, ((start, end + RAMP_S) for start, end in pauses))


def exclude_standstill(intervals: Iterable[Interval], pauses: Iterable[Interval]) -> tuple[Interval, ...]:
    """Return the parts of intervals without those in which a pause lets all motions stand still."""
    return subtract_intervals(intervals, ((start + RAMP_S, end) for start, end in pauses if start + RAMP_S < end))


def total_s(intervals: Iterable[Interval]) -> float:
    """Return the sum of the lengths in s."""
    return sum(end - start for start, end in intervals)


def _subtract(interval: Interval, gap: Interval) -> Iterator[Interval]:
    start, end = interval
    for part in ((start, min(end, gap[0])), (max(start, gap[1]), end)):
        if part[0] < part[1]:
            yield part
