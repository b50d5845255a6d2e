"""How often `retry`, `repeat` and `while` run their body at most."""

from __future__ import annotations

from skillc_dsl import syntax as s

MOST_ROUNDS = 1_000_000
"""More rounds than that count as endless."""


def count_rounds(written: s.Number) -> int:
    """Return a number of rounds as a whole number within 1 to MOST_ROUNDS; any other is reported as `bad-count`."""
    return int(min(max(written.value, 1), MOST_ROUNDS))
