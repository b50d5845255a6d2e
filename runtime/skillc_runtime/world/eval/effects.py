"""Turns effects of skills into changes of the world."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import assert_never

from skillc_model.conditions import Anything, Assert, Assign, Effect, Individual, Retract, Variable
from skillc_runtime.world.eval.expressions import Bindings, bound_value, value_of
from skillc_runtime.world.state.changes import AddRelation, Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState


def changes_of(effects: Iterable[Effect], state: WorldState, bindings: Bindings) -> tuple[Change, ...]:
    """Return the changes of effects; removals come first, so that all assertions hold afterwards.

    Relations that the world computes are not changed: they follow from what is.
    """
    computed = state.axioms.computed
    written = (each for each in effects if isinstance(each, Assign) or each.relation not in computed)
    changes = [change for effect in written for change in _changes(effect, state, bindings)]
    return tuple(sorted(changes, key=lambda change: not isinstance(change, RemoveRelation)))


def _changes(effect: Effect, state: WorldState, bindings: Bindings) -> Iterator[Change]:
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
