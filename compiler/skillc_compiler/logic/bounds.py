"""Comparisons of an expression with a constant, and the values that they allow."""

from __future__ import annotations

import math
from typing import TypeAlias, assert_never

import msgspec

from skillc_model.conditions import Compare, Condition, Expression, Literal, Operator
from skillc_model.rewriting import fold

MIRRORED: dict[Operator, Operator] = {"==": "==", "!=": "!=", "<": ">", "<=": ">=", ">": "<", ">=": "<="}
"""The operator that means the same with its sides exchanged."""
_OPPOSITE: dict[Operator, Operator] = {"==": "!=", "!=": "==", "<": ">=", "<=": ">", ">": "<=", ">=": "<"}


class Bound(msgspec.Struct, frozen=True):
    """`of operator value`"""

    of: Expression
    operator: Operator
    value: float | str | bool

    def opposite(self) -> Bound:
        """Return the bound that holds where this one does not."""
        return Bound(self.of, _OPPOSITE[self.operator], self.value)


def constant_bound(condition: Condition) -> Bound | None:
    """Return a comparison of an expression with a constant as a bound, None for any other condition."""
    if not isinstance(condition, Compare):
        return None
    match fold(condition.left), fold(condition.right):
        case (Literal(), Literal()):
            return None
        case left, Literal(value=value):
            return Bound(left, condition.operator, value)
        case Literal(value=value), right:
            return Bound(right, MIRRORED[condition.operator], value)
    return None


def are_disjoint(one: Bound, other: Bound) -> bool:
    """Whether no value satisfies both bounds, which must be of the same expression."""
    first, second = one.value, other.value
    if isinstance(first, str | bool) or isinstance(second, str | bool):
        equal = type(first) is type(second) and first == second
        return ({one.operator, other.operator} == {"==", "!="} and equal) or (
            one.operator == other.operator == "==" and not equal
        )
    return not _overlap(_interval(one.operator, first), _interval(other.operator, second)) or _are_equal_and_unequal(
        one, other
    )


def compare_constants(operator: Operator, left: float | str | bool, right: float | str | bool) -> bool:
    """Return whether a comparison of two constants holds; texts and truth values have no order."""
    match operator:
        case "==":
            return left == right
        case "!=":
            return left != right
        case "<" | "<=" | ">" | ">=" if isinstance(left, str) or isinstance(right, str):
            return False
        case "<" | "<=" | ">" | ">=":
            return _within(float(left), _interval(operator, float(right)))
        case _:
            assert_never(operator)


_Interval: TypeAlias = tuple[float, bool, float, bool]
"""Lower end, whether it belongs to the interval, upper end, whether it does."""


def _interval(operator: Operator, value: float) -> _Interval:
    match operator:
        case "==":
            return value, True, value, True
        case "<" | "<=":
            return -math.inf, False, value, operator == "<="
        case ">" | ">=":
            return value, operator == ">=", math.inf, False
        case "!=":
            return -math.inf, False, math.inf, False
        case _:
            assert_never(operator)


def _within(value: float, interval: _Interval) -> bool:
    return _overlap((value, True, value, True), interval)


def _overlap(one: _Interval, other: _Interval) -> bool:
    low, high = max(one[0], other[0]), min(one[2], other[2])
    lows = all(closed for end, closed in (one[:2], other[:2]) if end == low)
    highs = all(closed for end, closed in (one[2:], other[2:]) if end == high)
    return low < high or (low == high and lows and highs)


def _are_equal_and_unequal(one: Bound, other: Bound) -> bool:
    """Whether one is `==` and the other `!=` with the same number."""
    return {one.operator, other.operator} == {"==", "!="} and one.value == other.value
