"""Measures the things that a run put down."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_runtime.evaluation.measures.work import PlacingWork
from skillc_runtime.evaluation.report.result import PlacementResult


def measure(placements: Sequence[PlacementResult]) -> Iterator[PlacingWork]:
    """Yield each thing that was put down, of which the true and the believed place are known."""
    for each in placements:
        if not each.is_held and each.error_m is not None and each.turned_deg is not None:
            yield PlacingWork(
                thing=each.thing, error_m=each.error_m, turned_deg=each.turned_deg, missed_m=each.missed_m
            )
