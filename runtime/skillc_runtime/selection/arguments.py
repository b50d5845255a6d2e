"""Whether an argument suits a parameter: its type, its class, its range."""

from __future__ import annotations

import numpy as np

from skillc_compiler.library.skills import Parameter
from skillc_compiler.library.vocabulary import (
    THING,
    ClassType,
    DirectionType,
    ValueType,
    Vocabulary,
    local_name,
)
from skillc_compiler.library.words import type_text
from skillc_runtime.selection.describe import text_of
from skillc_runtime.world.state.value_types import is_of
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.vectors import is_vector
from skillc_runtime.world.state.world_state import WorldState


def problem_with(parameter: Parameter, value: Value, state: WorldState) -> str | None:
    """Return why the value cannot be the parameter's, None when it can."""
    vocabulary = state.vocabulary
    if not is_of(value, parameter.type, state):
        return f"needs {_wanted(parameter.type, vocabulary)}, {_description(value, parameter.type, state)}"
    if isinstance(value, int | float) and not isinstance(value, bool):
        return _out_of_range(parameter, float(value), vocabulary)
    return None


def _out_of_range(parameter: Parameter, value: float, vocabulary: Vocabulary) -> str | None:
    written = text_of(value, parameter.type, vocabulary)
    if parameter.low is not None and value < parameter.low:
        return f"{written} is below {text_of(parameter.low, parameter.type, vocabulary)}, the least it takes"
    if parameter.high is not None and value > parameter.high:
        return f"{written} is above {text_of(parameter.high, parameter.type, vocabulary)}, the most it takes"
    return None


def _description(value: Value, type_: ValueType, state: WorldState) -> str:
    """Say what a value is; of an individual its most specific classes."""
    written = text_of(value, type_, state.vocabulary)
    if isinstance(type_, DirectionType) and is_vector(value):
        return f"not {written}, whose length is {np.linalg.norm(value):g}"
    if not (isinstance(type_, ClassType) and isinstance(value, str)):
        return f"not {written}"
    if value not in state.individuals:
        return f"{written} is not in the world model"
    return f"{written} is {' and '.join(f'a {state.vocabulary.short(cls)}' for cls in _most_specific(value, state))}"


def _most_specific(individual: str, state: WorldState) -> list[str]:
    types = state.types(individual)
    above = {ancestor for cls in types for ancestor in state.vocabulary.ancestors.get(cls, ()) if ancestor != cls}
    return sorted(set(types) - above) or [THING]


def _wanted(type_: ValueType, vocabulary: Vocabulary) -> str:
    return local_name(type_.iri) if isinstance(type_, ClassType) else type_text(type_, vocabulary)
