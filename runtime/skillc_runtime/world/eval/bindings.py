"""The names in scope with their values, and functions that compute expressions from them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias, assert_never

from skillc_model.conditions import Anything, Individual, Term, Variable
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

Bindings: TypeAlias = Mapping[str, "Value | None"]
"""Values by name in scope; an unset optional parameter is missing or None."""

ExpressionFunction: TypeAlias = Callable[[WorldState, Bindings], "Value | None"]

ConditionTest: TypeAlias = Callable[[WorldState, Bindings], bool]


def bound_value(name: str, bindings: Bindings) -> Value:
    """Return the value of a name; EvaluationError for an optional parameter that was not passed."""
    value = bindings.get(name)
    if value is None:
        raise EvaluationError(f"`{name}` has no value: it was not passed (guard its use with `given {name}`)")
    return value


def iri_of(term: Term, bindings: Bindings) -> str | None:
    """Return the IRI of the individual that a term denotes; None when it is not bound."""
    match term:
        case Individual(iri):
            return iri
        case Variable(name):
            value = bindings.get(name)
            return value if isinstance(value, str) else None
        case Anything():
            return None
        case _:
            assert_never(term)
