"""Compares numbers that were computed with bounds: rounding decides nothing."""

from __future__ import annotations

from math import isclose

ROUNDING = 1e-9
"""How far apart, as a share of the larger one, two numbers may be that are equal but for rounding."""

_NEAR_ZERO = 1e-12
"""How far from zero, in SI units, a number may be that is zero but for rounding."""


def is_above(value: float, bound: float) -> bool:
    """Whether `value` is above `bound` by more than rounding: 3 * 0.1 is not above 0.3."""
    return value > bound and not is_same(value, bound)


def is_same(one: float, other: float) -> bool:
    """Whether two numbers are equal but for rounding."""
    return one == other or isclose(one, other, rel_tol=ROUNDING, abs_tol=_NEAR_ZERO)
