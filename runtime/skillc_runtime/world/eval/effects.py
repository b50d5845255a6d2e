"""Turns effects of skills into changes of the world."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import assert_never

from skillc_model.conditions import (
    Anything,
    Assert,
    Assign,
    Condition,
    Effect,
    ForEach,
    Individual,
    Retract,
    Variable,
    wanted_by,
)
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.expressions import Bindings, bound_value, value_of
from skillc_runtime.world.state.changes import AddRelation, Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState


def changes_of(
    effects: Iterable[Effect], state: WorldState, bindings: Bindings, before: WorldState | None = None
) -> tuple[Change, ...]:
    """Return the changes of effects; removals come first, so that all assertions hold afterwards.

    Relations that the world computes are not changed: they follow from what is. `before` is the state in which it was
    decided which individuals effects are on, if that is an earlier one.
    """
    computed = state.axioms.computed
    changes = [
        change
        for effect in effects
        for single, bound in _list_single(effect, before or state, bindings)
        if isinstance(single, Assign) or single.relation not in computed
        for change in _changes(single, state, bound)
    ]
    return tuple(sorted(changes, key=lambda change: not isinstance(change, RemoveRelation)))


def find_unmet(
    effects: Iterable[Effect], state: WorldState, bindings: Bindings, before: WorldState
) -> tuple[Condition, Bindings] | None:
    """Return what is not so that an effect should have made so of an individual that fulfilled its condition before."""
    for each in effects:
        if isinstance(each, ForEach):
            for single, bound in _list_single(each, before, bindings):
                wanted = wanted_by(single)
                if not evaluate(wanted, state, bound):
                    return wanted, bound
    return None


def _list_single(
    effect: Effect, before: WorldState, bindings: Bindings
) -> Iterator[tuple[Assert | Retract | Assign, Bindings]]:
    """Yield an effect on single individuals, with the values of its names."""
    if not isinstance(effect, ForEach):
        yield effect, bindings
        return
    for individual in sorted(before.instances(effect.cls)):
        bound = {**bindings, effect.variable: individual}
        if evaluate(effect.when, before, bound):
            yield effect.effect, bound


def _changes(effect: Assert | Retract | Assign, state: WorldState, bindings: Bindings) -> Iterator[Change]:
    match effect:
        case Assert(subject, relation, object_):
            yield AddRelation(_individual(subject, bindings), relation, _individual(object_, bindings))
        case Assign(subject, property_, value):
            yield SetProperty(_individual(subject, bindings), property_, value_of(value, state, bindings))
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
