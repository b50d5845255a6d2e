"""Compares the signals of two runs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from skillc.contract.runs.run_diff import Difference
from skillc.services.run_diff.difference import find_difference
from skillc_runtime.motion.pose import Array

DIGITS = 1e-8
"""Signals that differ by less than this part of their range are equal: CSV files have nine significant digits."""


def compare_signals(first: Mapping[str, Array], second: Mapping[str, Array]) -> Iterator[Difference]:
    """Yield the signals of both runs, samples (n,) by column, whose peaks or means differ.

    A peak is the greatest absolute value.
    """
    for name in first.keys() & second.keys():
        one, other = (values[np.isfinite(values)] for values in (first[name], second[name]))
        if not len(one) or not len(other):
            continue
        both = np.concatenate((one, other))
        range_ = float(np.max(both) - np.min(both))
        measures = {"peak": (_peak(one), _peak(other)), "mean": (float(np.mean(one)), float(np.mean(other)))}
        for what, pair in measures.items():
            size = abs(pair[0] - pair[1]) / range_ if range_ > 0.0 else 0.0
            if size > DIGITS:
                yield from find_difference("signals", f"{name} {what}", pair, size)


def _peak(values: Array) -> float:
    return float(np.max(np.abs(values)))
