"""Interval arithmetic: the range of an expression, from the ranges of the parameters in it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import inf, isnan
from typing import TypeAlias, assert_never

from skillc_compiler.program.typed import Let, Parameter
from skillc_model.conditions import (
    Aggregate,
    Arithmetic,
    Expression,
    Individual,
    Invoke,
    ListValue,
    Literal,
    Message,
    PropertyOf,
    Variable,
)
from skillc_model.rewriting import constant_number

Interval: TypeAlias = tuple[float, float]
"""The least and the greatest value, in SI units."""


def parameter_intervals(parameters: Iterable[Parameter], lets: Iterable[Let] = ()) -> dict[str, Interval]:
    """Return the intervals of parameters that have a range, and of `let` values computed from them."""
    known: dict[str, Interval] = {}
    for parameter in parameters:
        low, high = (constant_number(bound.meaning) if bound else None for bound in (parameter.low, parameter.high))
        if low is not None and high is not None and low <= high:
            known[parameter.name] = (low, high)
    for let in lets:
        found = interval_of(let.value.meaning, known)
        if found is not None:
            known[let.name.text] = found
    return known


def interval_of(expression: Expression, known: Mapping[str, Interval]) -> Interval | None:
    """Return the interval of an expression, or None if a part of it is unknown."""
    match expression:
        case Literal(value=bool() | str()):
            return None
        case Literal(value=value):
            return float(value), float(value)
        case Variable(name=name):
            return known.get(name)
        case Arithmetic(operator=operator, left=left, right=right):
            one, other = interval_of(left, known), interval_of(right, known)
            return _combine(operator, one, other) if one is not None and other is not None else None
        case Aggregate(function="count"):
            return 0.0, inf
        case Individual() | PropertyOf() | Invoke() | ListValue() | Aggregate() | Message():
            return None
        case _:
            assert_never(expression)


def _combine(operator: str, one: Interval, other: Interval) -> Interval | None:
    match operator:
        case "+":
            return one[0] + other[0], one[1] + other[1]
        case "-":
            return one[0] - other[1], one[1] - other[0]
        case "/" if other[0] <= 0 <= other[1]:
            return None
        case "/":
            other = 1 / other[1], 1 / other[0]
    products = [a * b for a in one for b in other]
    return None if any(isnan(each) for each in products) else (min(products), max(products))
