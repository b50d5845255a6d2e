"""Finds what makes a condition false that somebody could change: a property without a value, what a reasoner says."""

from __future__ import annotations

import msgspec

from skillc_model.conditions import Compare, Condition, HasProperty, Holds, Individual, PropertyOf
from skillc_runtime.world.eval.expressions import Bindings, compile_expression, find_missing_value, iri_of
from skillc_runtime.world.state.world_state import WorldState


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
