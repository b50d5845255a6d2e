"""Between which values a number is once effects have changed it by certain amounts."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from math import inf, isfinite
from typing import Literal as OneOf

from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.logic.intervals import Interval, interval_of
from skillc_model.conditions import (
    Adjust,
    Arithmetic,
    Compare,
    Condition,
    Effect,
    Expression,
    Individual,
    Literal,
    PropertyOf,
    Variable,
)


def bounds_of_changed(before: State, effects: Iterable[Effect], properties: Collection[str]) -> dict[Condition, bool]:
    """Return what is known of numbers of these properties after effects that read the state `before`."""
    found: dict[Condition, bool] = {}
    for effect in effects:
        if not isinstance(effect, Adjust) or effect.property not in properties:
            continue
        number = PropertyOf(_owner(before, effect.subject), effect.property)
        least = -inf if effect.low is None else _interval(before, effect.low)[0]
        most = inf if effect.high is None else _interval(before, effect.high)[1]
        found |= {Compare(number, sign, end): True for sign, end in _ends(least, most)}
    return found


def _interval(state: State, value: Expression) -> Interval:
    match value:
        case PropertyOf(of=Variable() | Individual() as of, property=iri):
            return _bounds(state, PropertyOf(_owner(state, of), iri))
        case Arithmetic(operator=operator, left=left, right=right):
            known = {"left": _interval(state, left), "right": _interval(state, right)}
            return interval_of(Arithmetic(operator, Variable("left"), Variable("right")), known) or (-inf, inf)
        case _:
            return interval_of(value, {}) or (-inf, inf)


def _bounds(state: State, number: PropertyOf) -> Interval:
    least, most = -inf, inf
    for fact, true in state.facts.items():
        match fact:
            case Compare(left=left, operator=sign, right=Literal(value=int() | float() as end)) if true:
                if left == number and sign in ("==", ">=", ">"):
                    least = max(least, end)
                if left == number and sign in ("==", "<=", "<"):
                    most = min(most, end)
    return least, most


def _owner(state: State, of: Variable | Individual) -> Variable | Individual:
    owner = state.aliases.get(of.name, of) if isinstance(of, Variable) else of
    return owner if isinstance(owner, Variable | Individual) else of


def _ends(least: float, most: float) -> Iterator[tuple[OneOf["==", ">=", "<="], Literal]]:
    """Yield the ends that there are, without what rounding has added to them."""
    if least == most:
        yield "==", Literal(float(f"{least:.12g}"))
        return
    if isfinite(least):
        yield ">=", Literal(float(f"{least:.12g}"))
    if isfinite(most):
        yield "<=", Literal(float(f"{most:.12g}"))
