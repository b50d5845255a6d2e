"""Selects candidates for quantified conditions from the indexes, so that not all individuals are tested."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias, TypeGuard

from skillc_model.conditions import And, Anything, Condition, Exists, Forall, Holds, Individual, Not, Or, Term, Variable
from skillc_runtime.world.eval.expressions import Bindings, bound_value
from skillc_runtime.world.state.world_state import WorldState

Candidates: TypeAlias = Callable[[WorldState, Bindings], frozenset[str]]


def candidates(condition: Exists | Forall) -> Candidates:
    """Return a function that returns candidates, among them all individuals that decide the condition.

    For `exists x: C (.. x r a ..)` those that have the relation; for `forall` those that could violate the body.
    """
    variable, body = condition.variable, condition.body
    needed = body if isinstance(condition, Exists) else _negation(body)
    for part in needed.parts if isinstance(needed, And) else (needed,):
        if isinstance(part, Holds):
            if _is(part.subject, variable) and _fixed(part.object, variable):
                return _subjects(part.relation, part.object)
            if _is(part.object, variable) and _fixed(part.subject, variable):
                return _objects(part.subject, part.relation)
    cls = condition.cls
    return lambda state, bindings: state.instances(cls)


def _negation(condition: Condition) -> Condition:
    match condition:
        case Not(body):
            return body
        case Or(parts):
            return And(tuple(_negation(part) for part in parts))
        case _:
            return Not(condition)


def _is(term: Term, variable: str) -> bool:
    return isinstance(term, Variable) and term.name == variable


def _fixed(term: Term, variable: str) -> TypeGuard[Variable | Individual]:
    return not isinstance(term, Anything) and not _is(term, variable)


def _subjects(relation: str, object_: Variable | Individual) -> Candidates:
    return lambda state, bindings: state.subjects(relation, _individual(object_, bindings))


def _objects(subject: Variable | Individual, relation: str) -> Candidates:
    return lambda state, bindings: state.objects(_individual(subject, bindings), relation)


def _individual(term: Variable | Individual, bindings: Bindings) -> str:
    return term.iri if isinstance(term, Individual) else str(bound_value(term.name, bindings))
