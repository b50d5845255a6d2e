"""Finds what makes a condition false that somebody could change: a value or facts that lack, what a reasoner says."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

import msgspec

from skillc_model.conditions import And, Compare, Condition, Exists, HasProperty, Holds, Individual, Or, PropertyOf
from skillc_runtime.cancellation import check_current
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.expressions import Bindings, compile_expression, find_missing_value, iri_of
from skillc_runtime.world.state.world_state import WorldState

_Facts: TypeAlias = tuple[Holds, ...]


class RelationObstacle(msgspec.Struct, frozen=True):
    """What the reasoner of a computed relation says against it, for two individuals."""

    relation: str
    subject: str
    object: str
    reason: str

    def __str__(self) -> str:
        return self.reason


def find_obstacle(condition: Condition, state: WorldState, bindings: Bindings) -> RelationObstacle | None:
    """Return what the reasoner of a computed relation says against it; None for any other condition, or if it holds."""
    match condition:
        case Holds(subject, relation, object_) if relation in state.axioms.computed:
            start, end = iri_of(subject, bindings), iri_of(object_, bindings)
            if start is None or end is None:
                return None
            reason = state.axioms.computed[relation].obstacle(state, start, end)
            return None if reason is None else RelationObstacle(relation, start, end, reason)
        case _:
            return None


def find_missing_property(condition: Condition, state: WorldState, bindings: Bindings) -> PropertyOf | None:
    """Return the property, of an individual, whose missing value makes a condition false; None if that is not why."""
    match condition:
        case Compare(left, _, right):
            lacking = next((each for each in (left, right) if compile_expression(each)(state, bindings) is None), None)
            found = None if lacking is None else find_missing_value(lacking, state, bindings)
            return found if isinstance(found, PropertyOf) else None
        case HasProperty(subject, property_):
            owner = iri_of(subject, bindings)
            return None if owner is None else PropertyOf(Individual(owner), property_)
        case _:
            return None


def find_missing_facts(condition: Condition, state: WorldState, bindings: Bindings) -> _Facts:
    """Return the fewest relations of individuals that a condition lacks; none if others would do, or these would not.

    EvaluationError as in `evaluate`.
    """
    ways = _find_lacking(condition, state, bindings)
    return ways[0] if len(ways) == 1 else ()


def _find_lacking(condition: Condition, state: WorldState, bindings: Bindings) -> list[_Facts]:
    """Return what a condition lacks, for two of the ways to fulfil it with the fewest relations; none if none does."""
    check_current()
    if evaluate(condition, state, bindings):
        return [()]
    match condition:
        case Holds(subject, relation, object_) if relation not in state.axioms.computed:
            start, end = iri_of(subject, bindings), iri_of(object_, bindings)
            if start is None or end is None:
                return []
            return [(Holds(Individual(start), relation, Individual(end)),)]
        case And(parts):
            ways: list[_Facts] = [()]
            for part in parts:
                ways = _fewest((*one, *other) for other in _find_lacking(part, state, bindings) for one in ways)
            return ways
        case Or(parts):
            return _fewest(each for part in parts for each in _find_lacking(part, state, bindings))
        case Exists(variable, cls, body):
            scopes = ({**bindings, variable: each} for each in sorted(state.instances(cls)))
            return _fewest(each for scope in scopes for each in _find_lacking(body, state, scope))
        case _:
            return []


def _fewest(ways: Iterable[_Facts]) -> list[_Facts]:
    distinct = list(dict.fromkeys(tuple(dict.fromkeys(each)) for each in ways))
    least = min(map(len, distinct), default=0)
    return [each for each in distinct if len(each) == least][:2]
