"""Checks values against types of the language and properties of a vocabulary."""

from __future__ import annotations

from typing import assert_never

from skillc_rdf.vocabulary.text_forms import FORMS
from skillc_rdf.vocabulary.types import (
    ClassType,
    DirectionType,
    ListType,
    NumberType,
    PlainType,
    PropertyTerm,
    ValueType,
    VectorType,
)
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.state.values import Value, is_finite
from skillc_runtime.world.state.vectors import is_direction, is_vector
from skillc_runtime.world.state.world_state import WorldState


def is_of_type(value: Value, type_: ValueType, state: WorldState) -> bool:
    """Whether a value is of a type; an individual must exist, a number must be finite, a direction have length 1."""
    match type_:
        case ClassType(iri=iri):
            return isinstance(value, str) and value in state.individuals and state.is_a(value, iri)
        case NumberType():
            return isinstance(value, int | float) and not isinstance(value, bool) and is_finite(value)
        case VectorType():
            return is_vector(value) and is_finite(value)
        case DirectionType():
            return is_direction(value)
        case PlainType(name=name):
            return _is_plain(value, name)
        case ListType(element=element):
            return isinstance(value, tuple) and all(is_of_type(part, element, state) for part in value)
        case _:
            assert_never(type_)


def _is_plain(value: Value, name: str) -> bool:
    kinds: dict[str, type] = {"Bool": bool, "Int": int, "Text": str, "Message": str, "Pose": Pose}
    return isinstance(value, kinds[name]) and (name == "Bool" or not isinstance(value, bool))


def value_error(term: PropertyTerm, value: Value) -> str | None:
    """Return what a property takes if the value is not valid, None if it is; of several values, call it for each."""
    if not is_finite(value):
        return "NaN and infinity are no values"
    expected = _expected(term.type, value)
    if expected is not None:
        return f"it takes {expected}"
    form = FORMS.get(term.datatype)
    if form is not None and isinstance(value, str) and not form.fits(value):
        return f"it takes a text as in {form.example}"
    if term.values and value not in term.values:
        return "it is one of " + ", ".join(term.values)
    if term.bounds is not None and isinstance(value, int | float) and not term.bounds.hold(value):
        return f"it is {term.bounds}"
    return None


def _expected(type_: ValueType, value: Value) -> str | None:
    """Return what a type takes if the value is not of that type."""
    number = isinstance(value, int | float) and not isinstance(value, bool)
    match type_:
        case NumberType():
            return None if number else "a number"
        case PlainType("Bool"):
            return None if isinstance(value, bool) else "true or false"
        case PlainType("Int"):
            return None if number and isinstance(value, int | float) and value == int(value) else "a whole number"
        case PlainType("Text"):
            return None if isinstance(value, str) else "a text"
        case PlainType("Pose"):
            return None if isinstance(value, Pose) else "a pose"
        case VectorType():
            return None if is_vector(value) else "a vector of three numbers"
        case DirectionType():
            return None if is_direction(value) else "a direction: a vector of length 1"
        case ClassType():
            return None if isinstance(value, str) else "an individual"
        case ListType():
            return None if isinstance(value, tuple) else "a list"
        case _:
            raise AssertionError(f"no such type: {type_}")
