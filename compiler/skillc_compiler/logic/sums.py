"""Numbers that are a constant and multiples of values which stay as they are, and changes of a number between two."""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce
from math import inf, isfinite, isnan
from typing import TypeAlias

import msgspec

from skillc_compiler.logic.intervals import Interval
from skillc_model.conditions import Adjust, Arithmetic, Expression, Individual, Literal, PropertyOf, Variable
from skillc_model.rewriting import constant_number, fold

BoundsOf: TypeAlias = Callable[[Expression], Interval]
"""The least and the greatest value that an expression may have."""
ROUNDING = 1e-9
"""Numbers that differ by no more than this share of them are the same."""


MOST_TERMS = 16
"""A product with more terms is a value of its own."""


class Sum(msgspec.Struct, frozen=True):
    """A constant and multiples of values and of products of values, each once and in the order of their texts."""

    number: float = 0.0
    terms: tuple[tuple[Expression, float], ...] = ()

    def plus(self, other: Sum, times: float = 1.0) -> Sum:
        """Return the sum of this and a multiple of another one."""
        terms = dict(self.terms)
        for value, factor in other.terms:
            terms[value] = terms.get(value, 0.0) + times * factor
        kept = sorted((each for each in terms.items() if each[1]), key=repr)
        return Sum(self.number + times * other.number, tuple(kept))

    def product(self, other: Sum) -> Sum:
        """Return the product with another sum, term by term."""
        found = Sum(self.number * other.number)
        found = found.plus(Sum(0.0, other.terms), self.number).plus(Sum(0.0, self.terms), other.number)
        for value, factor in self.terms:
            for another, times in other.terms:
                found = found.plus(Sum(0.0, ((_product([*_factors(value), *_factors(another)]), factor * times),)))
        return found

    def interval(self, bounds: BoundsOf) -> Interval:
        """Return between which numbers it is."""
        low = high = self.number
        for value, factor in self.terms:
            ends = [factor * end for end in bounds(value)]
            low, high = low + min(ends), high + max(ends)
        return (-inf if isnan(low) else low), (inf if isnan(high) else high)


def sum_of(expression: Expression) -> Sum:
    """Return an expression as a sum; what is no sum of multiples is a value of its own."""
    number = constant_number(expression)
    if number is not None:
        return Sum(number)
    match expression:
        case Arithmetic(operator="+" | "-" as operator, left=left, right=right):
            return sum_of(left).plus(sum_of(right), 1.0 if operator == "+" else -1.0)
        case Arithmetic(operator="*", left=left, right=right):
            one, other = sum_of(left), sum_of(right)
            if len(one.terms) * len(other.terms) <= MOST_TERMS:
                return one.product(other)
        case Arithmetic(operator="/", left=left, right=right) if divisor := constant_number(right):
            return Sum().plus(sum_of(left), 1 / divisor)
    return Sum(0.0, ((fold(expression), 1.0),))


def _factors(value: Expression) -> list[Expression]:
    match value:
        case Arithmetic(operator="*", left=left, right=right):
            return [*_factors(left), *_factors(right)]
    return [value]


def _product(factors: list[Expression]) -> Expression:
    """Return a product of values, in the order of their texts."""
    return reduce(lambda left, right: Arithmetic("*", left, right), sorted(factors, key=repr))


class Change(msgspec.Struct, frozen=True):
    """What becomes of a number: it is changed by a sum from `low` to `high`, or set to one; None where it is open.

    `is_known` if there certainly is one afterwards.
    """

    low: Sum | None = Sum()
    high: Sum | None = Sum()
    is_set: bool = False
    is_known: bool = False

    @property
    def is_nothing(self) -> bool:
        """Whether the number stays as it is."""
        return not self.is_set and self.low == self.high == Sum()

    @property
    def is_open(self) -> bool:
        """Whether the number may be any afterwards."""
        return self.low is None and self.high is None

    def then(self, later: Change) -> Change:
        """Return this change and a later one."""
        if later.is_set:
            return later
        is_known = self.is_known or later.is_known
        return Change(_plus(self.low, later.low), _plus(self.high, later.high), self.is_set, is_known)


UNCHANGED = Change()
OPEN = Change(None, None)


def join(one: Change | None, other: Change | None, bounds: BoundsOf) -> Change | None:
    """Return a change that is either of two; None is none at all."""
    if one is None or other is None or one == other:
        return one or other
    is_known = one.is_known and other.is_known
    if one.is_set != other.is_set:
        return Change(None, None, is_known=is_known)
    low = _lower(one.low, other.low, bounds)
    high = _lower(_minus(one.high), _minus(other.high), bounds)
    return Change(low, _minus(high), one.is_set, is_known)


def repeat(change: Change, least: int, most: float, bounds: BoundsOf) -> Change:
    """Return a change that happens so often; `most` may be infinite."""
    if change.is_set:
        return change if least else OPEN
    low = _times(change.low, least, most, bounds)
    high = _minus(_times(_minus(change.high), least, most, bounds))
    return Change(low, high, is_known=change.is_known and least > 0)


def contains(outer: Change, inner: Change, bounds: BoundsOf) -> bool:
    """Whether each number that a change may lead to is one to which the outer may lead."""
    if outer.is_open:
        return inner.is_known
    if outer.is_set != inner.is_set:
        return False
    return _is_below(outer.low, inner.low, bounds) and _is_below(_minus(outer.high), _minus(inner.high), bounds)


def _is_below(one: Sum | None, other: Sum | None, bounds: BoundsOf) -> bool:
    """Whether a lower end is not above another one; an open end is below all."""
    if one is None:
        return True
    if other is None:
        return False
    gap = other.plus(one, -1.0)
    return gap.interval(bounds)[0] >= -ROUNDING * max(1.0, abs(one.number), abs(other.number))


def _lower(one: Sum | None, other: Sum | None, bounds: BoundsOf) -> Sum | None:
    """Return the lower of two ends, or a constant below both."""
    if one is None or other is None:
        return None
    low, high = one.plus(other, -1.0).interval(bounds)
    if high <= 0:
        return one
    if low >= 0:
        return other
    least = min(one.interval(bounds)[0], other.interval(bounds)[0])
    return Sum(least) if isfinite(least) else None


def _times(low: Sum | None, least: int, most: float, bounds: BoundsOf) -> Sum | None:
    """Return the lowest end after so many times."""
    if low is None:
        return None if most else Sum()
    if low == Sum():
        return low
    fewest = Sum().plus(low, least)
    if isfinite(most):
        return _lower(fewest, Sum().plus(low, most), bounds)
    return fewest if low.interval(bounds)[0] >= 0 else None


def _plus(one: Sum | None, other: Sum | None) -> Sum | None:
    return None if one is None or other is None else one.plus(other)


def _minus(one: Sum | None) -> Sum | None:
    return None if one is None else Sum().plus(one, -1.0)


def effect_of(change: Change, subject: Variable | Individual, property_: str) -> Adjust:
    """Return a change as the effect on a number."""
    number = PropertyOf(subject, property_)
    before = Sum() if change.is_set else sum_of(number)
    low, high = (None if each is None else _expression(before.plus(each)) for each in (change.low, change.high))
    return Adjust(subject, property_, low, high)


def _expression(sum_: Sum) -> Expression:
    found: Expression = Literal(sum_.number)
    for value, factor in sum_.terms:
        found = Arithmetic("+", found, value if factor == 1 else Arithmetic("*", Literal(factor), value))
    return found
