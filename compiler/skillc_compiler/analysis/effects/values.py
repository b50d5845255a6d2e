"""What is known of the values by which numbers are changed: those that stay as they are, and between which they are."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import inf, isfinite

from msgspec import structs

from skillc_compiler.analysis.exploration import Exploration
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.knowledge.writes import PropertyWrite, RelationWrite
from skillc_compiler.logic.intervals import Interval, interval_of, parameter_intervals
from skillc_compiler.logic.sums import OPEN, Change, Sum, sum_of
from skillc_compiler.program.typed import Implementation
from skillc_model.conditions import Adjust, Assign, Compare, Expression, Literal, PropertyOf
from skillc_model.read_write import terms_read
from skillc_model.traversal import free_variables


@dataclass(frozen=True)
class Values:
    """The values in the amounts of one body; `start` is the state at its start."""

    run: Exploration
    implementation: Implementation
    start: State

    def change_by(self, effect: Assign | Adjust) -> Change:
        """Return what an effect does to its number, with values of which all are as they were at the start."""
        low, high = (effect.value, effect.value) if isinstance(effect, Assign) else (effect.low, effect.high)
        number = PropertyOf(effect.subject, effect.property)
        ends = [sum_of(each) if each is not None else None for each in (low, high)]
        factors = {dict(each.terms).get(number, 0.0) for each in ends if each is not None}
        if factors not in ({0.0}, {1.0}):
            return structs.replace(OPEN, is_known=True)
        factor = factors.pop()
        without = [each.plus(sum_of(number), -factor) if each is not None else None for each in ends]
        low_end, high_end = self._settle(without[0], 1.0), self._settle(without[1], -1.0)
        return Change(low_end, high_end, is_set=factor == 0.0, is_known=True)

    def bounds(self, value: Expression) -> Interval:
        """Return between which numbers a value is."""
        known = interval_of(value, self._parameters)
        if known is not None:
            return known
        low, high = self._range(value)
        for fact, true in self.start.facts.items():
            match fact:
                case Compare(left=left, operator=">=" | ">", right=Literal(value=float() | int() as end)) if true:
                    low = max(low, end) if left == value else low
                case Compare(left=left, operator="<=" | "<", right=Literal(value=float() | int() as end)) if true:
                    high = min(high, end) if left == value else high
        return low, high

    def _range(self, value: Expression) -> Interval:
        """Return between which numbers a value is at any time."""
        term = self.run.types.vocabulary.properties.get(value.property) if isinstance(value, PropertyOf) else None
        if term is None or term.bounds is None:
            return -inf, inf
        lows = [each for each in (term.bounds.least, term.bounds.above) if each is not None]
        highs = [each for each in (term.bounds.greatest, term.bounds.below) if each is not None]
        return max(lows, default=-inf), min(highs, default=inf)

    @cached_property
    def _parameters(self) -> dict[str, Interval]:
        return parameter_intervals(self.implementation.parameters, self.implementation.lets)

    @cached_property
    def _written(self) -> frozenset[str]:
        writes = self.run.summaries.all_writes(self.implementation)
        relations = {each.relation for each in writes if isinstance(each, RelationWrite)}
        return frozenset(relations | {each.property for each in writes if isinstance(each, PropertyWrite)})

    def _settle(self, end: Sum | None, sign: float) -> Sum | None:
        """Return a lower (`sign` 1) or upper (-1) end with constants for what may be another value by then."""
        if end is None:
            return None
        settled = Sum(end.number)
        for value, factor in end.terms:
            if free_variables(value) <= self.run.stable and self._written.isdisjoint(terms_read(value)):
                settled = settled.plus(sum_of(value), factor)
                continue
            ends = [factor * each for each in self._range(value)]
            least = min(ends) if sign > 0 else max(ends)
            if not isfinite(least):
                return None
            settled = settled.plus(Sum(least))
        return settled
