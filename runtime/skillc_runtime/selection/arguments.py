"""Whether an argument suits a parameter: its type, its class, its range."""

from __future__ import annotations

from typing import assert_never

import numpy as np

from skillc_compiler.library.skills import Parameter
from skillc_compiler.library.vocabulary import (
    THING,
    ClassType,
    ListType,
    NumberType,
    PlainType,
    ValueType,
    VectorType,
    Vocabulary,
    local_name,
)
from skillc_compiler.library.words import type_text
from skillc_runtime.motion.pose import Pose
from skillc_runtime.selection.describe import text_of
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.values import Value, finite


def problem_with(parameter: Parameter, value: Value, state: WorldState) -> str | None:
    """Return why the value cannot be the parameter's, None when it can."""
    vocabulary = state.vocabulary
    if not _is_of(value, parameter.type, state):
        return f"needs {_wanted(parameter.type, vocabulary)}, {_description(value, parameter.type, state)}"
    if isinstance(value, int | float) and not isinstance(value, bool):
        return _out_of_range(parameter, float(value), vocabulary)
    return None


def _is_of(value: Value, type_: ValueType, state: WorldState) -> bool:
    match type_:
        case ClassType(iri=iri):
            return isinstance(value, str) and value in state.individuals and state.is_a(value, iri)
        case NumberType():
            return isinstance(value, int | float) and not isinstance(value, bool) and finite(value)
        case VectorType():
            return isinstance(value, np.ndarray) and value.shape == (3,) and finite(value)
        case PlainType(name=name):
            return _is_plain(value, name)
        case ListType(element=element):
            return isinstance(value, tuple) and all(_is_of(part, element, state) for part in value)
        case _:
            assert_never(type_)


def _is_plain(value: Value, name: str) -> bool:
    kinds: dict[str, type | tuple[type, ...]] = {"Bool": bool, "Int": int, "Text": str, "Pose": Pose}
    return isinstance(value, kinds[name]) and (name == "Bool" or not isinstance(value, bool))


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
