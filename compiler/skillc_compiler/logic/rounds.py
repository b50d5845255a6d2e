"""The maximum number of rounds of `retry`, `repeat` and `while`."""

from __future__ import annotations

from skillc_dsl import syntax as s
from skillc_model.tree import MOST_ROUNDS


def count_rounds(written: s.Number) -> int:
    """Return a number of rounds as an integer from 1 to MOST_ROUNDS; other values are reported as `bad-count`."""
    return int(min(max(written.value, 1), MOST_ROUNDS))
