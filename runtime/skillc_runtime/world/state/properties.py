"""Values of properties in a version of the world: stored, or computed by the Python function of the vocabulary."""

from __future__ import annotations

from typing import cast

from skillc_rdf.vocabulary.types import local_name
from skillc_runtime.motion.arrays import np
from skillc_runtime.world.state.python_calls import EvaluationError, call_python, load_python
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


def property_of(state: WorldState, individual: str, property_: str) -> Value | None:
    """Return the value of a property, stored or computed; None when missing, EvaluationError when its Python fails.

    The value of a functional relation is the one thing to which it leads.
    """
    term = state.vocabulary.properties.get(property_)
    if term is None:
        return next(iter(state.objects(individual, property_)), None)
    if term.computed_by is None:
        return state.value(individual, property_)
    return value_from_python(term.computed_by, local_name(property_), state, individual)


def value_at(state: WorldState, individual: str, property_: str) -> Value | None:
    """Return the value of a property, stored or computed; None when missing or when it cannot be computed."""
    try:
        return property_of(state, individual, property_)
    except EvaluationError:
        return None


def value_from_python(target: str, name: str, state: WorldState, *arguments: Value) -> Value | None:
    """Call the Python function of a property or function `name`; its exceptions become EvaluationErrors."""
    result: Value | None = call_python(load_python(target), name, state, *arguments)
    return None if result is None else _as_value(result)


def _as_value(result: Value) -> Value:
    """Return lists and NumPy scalars as tuples and Python numbers, recursively."""
    if isinstance(result, np.generic):
        return cast(Value, result.item())
    return tuple(map(_as_value, result)) if isinstance(result, list | tuple) else result
