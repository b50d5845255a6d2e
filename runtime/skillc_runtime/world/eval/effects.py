"""Turns effects of skills into changes of the world."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import assert_never

from msgspec.structs import replace

from skillc_model.conditions import (
    Adjust,
    Anything,
    Assert,
    Assign,
    Condition,
    Effect,
    Expression,
    ForEach,
    HasProperty,
    Individual,
    Literal,
    Retract,
    SingleEffect,
    Variable,
    wanted_by,
)
from skillc_model.rounding import is_same
from skillc_rdf.vocabulary.types import Bounds
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.expressions import Bindings, bound_value, value_of
from skillc_runtime.world.state.changes import AddRelation, Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.properties import property_of
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


def changes_of(
    effects: Iterable[Effect], state: WorldState, bindings: Bindings, before: WorldState | None = None
) -> tuple[Change, ...]:
    """Return the changes of effects; removals come first, so that all assertions hold afterwards.

    Relations that the world computes are not changed: they follow from what is. `before` is the state in which it was
    decided which individuals effects are on, and from which changes of numbers are computed, if that is an earlier one.
    A number of which only bounds are known becomes the nearest one within them.
    """
    before = before or state
    computed = state.axioms.computed
    changes = [
        change
        for effect in effects
        for single, bound in _list_single(effect, before, bindings)
        if isinstance(single, Assign | Adjust) or single.relation not in computed
        for change in _changes(_settle(single, before, bound), state, bound)
    ]
    return tuple(sorted(changes, key=lambda change: not isinstance(change, RemoveRelation)))


def find_unmet(
    effects: Iterable[Effect], state: WorldState, bindings: Bindings, before: WorldState
) -> tuple[Condition, Bindings] | None:
    """Return what is not so that an effect should have made so, as it depends on the state before.

    Where a tolerance is exceeded, that is what was to be without it.
    """
    for each in effects:
        if isinstance(each, ForEach | Adjust):
            for single, bound in _list_single(each, before, bindings):
                settled = _settle(single, before, bound)
                if not evaluate(wanted_by(settled), state, bound):
                    return wanted_by(_without_tolerance(settled)), bound
    return None


def list_changed(
    effects: Iterable[Effect], bindings: Bindings, before: WorldState
) -> Iterator[tuple[HasProperty, Bindings]]:
    """Yield the numbers that effects change."""
    for each in effects:
        for single, bound in _list_single(each, before, bindings):
            if isinstance(single, Adjust):
                yield HasProperty(single.subject, single.property), bound


def _without_tolerance(effect: SingleEffect) -> SingleEffect:
    return replace(effect, tolerance=None) if isinstance(effect, Adjust) else effect


def _list_single(effect: Effect, before: WorldState, bindings: Bindings) -> Iterator[tuple[SingleEffect, Bindings]]:
    """Yield an effect on single individuals, with the values of its names."""
    if not isinstance(effect, ForEach):
        yield effect, bindings
        return
    for individual in sorted(before.instances(effect.cls)):
        bound = {**bindings, effect.variable: individual}
        if evaluate(effect.when, before, bound):
            yield effect.effect, bound


def _settle(effect: SingleEffect, before: WorldState, bindings: Bindings) -> SingleEffect:
    """Return a change of a number with the numbers that its bounds are in the state before; any other as it is."""
    if not isinstance(effect, Adjust):
        return effect
    low, high = (each and Literal(_number(each, before, bindings)) for each in (effect.low, effect.high))
    return replace(effect, low=low, high=high)


def _number(expression: Expression, state: WorldState, bindings: Bindings) -> int | float:
    value = value_of(expression, state, bindings)
    if not isinstance(value, int | float):
        raise EvaluationError(f"{value!r} is not a number")
    return value


def _find_nearest(effect: Adjust, state: WorldState, bindings: Bindings) -> Value | None:
    """Return the number within its bounds that is nearest to what it is, or else to zero; None if none is needed."""
    low, high = (None if each is None else _number(each, state, bindings) for each in (effect.low, effect.high))
    now = property_of(state, _individual(effect.subject, bindings), effect.property)
    low, high = (_snap(each, state.vocabulary.properties[effect.property].bounds) for each in (low, high))
    if not isinstance(now, int | float):
        now = 0.0 if low is not None or high is not None else None
    if now is not None and low is not None and now < low:
        return low
    return high if now is not None and high is not None and now > high else now


def _snap(value: float | None, bounds: Bounds | None) -> float | None:
    """Return the bound of a property that a number is but for rounding; else the number."""
    ends = (bounds.least, bounds.greatest) if bounds is not None else ()
    return next((end for end in ends if value is not None and end is not None and is_same(value, end)), value)


def _changes(effect: SingleEffect, state: WorldState, bindings: Bindings) -> Iterator[Change]:
    match effect:
        case Assert(subject, relation, object_):
            yield AddRelation(_individual(subject, bindings), relation, _individual(object_, bindings))
        case Assign(subject, property_, value):
            yield SetProperty(_individual(subject, bindings), property_, value_of(value, state, bindings))
        case Adjust(subject, property_):
            nearest = _find_nearest(effect, state, bindings)
            if nearest is not None:
                yield SetProperty(_individual(subject, bindings), property_, nearest)
        case Retract(Anything(), relation, Anything()):
            yield from (RemoveRelation(start, relation, end) for start, end in sorted(state.pairs(relation)))
        case Retract(Anything(), relation, Variable() | Individual() as object_):
            end = _individual(object_, bindings)
            yield from (RemoveRelation(start, relation, end) for start in sorted(state.subjects(relation, end)))
        case Retract(Variable() | Individual() as subject, relation, Anything()):
            start = _individual(subject, bindings)
            yield from (RemoveRelation(start, relation, end) for end in sorted(state.objects(start, relation)))
        case Retract(Variable() | Individual() as subject, relation, Variable() | Individual() as object_):
            yield RemoveRelation(_individual(subject, bindings), relation, _individual(object_, bindings))
        case Retract():
            raise EvaluationError(f"{effect} names no individuals")
        case _:
            assert_never(effect)


def _individual(term: Variable | Individual, bindings: Bindings) -> str:
    value = term.iri if isinstance(term, Individual) else bound_value(term.name, bindings)
    if not isinstance(value, str):
        raise EvaluationError(f"`{term}` is {value!r}, which is not an individual")
    return value
