"""Values, types and parameters in the words of a message."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import assert_never

from skillc_compiler.library.skills import Parameter
from skillc_compiler.library.vocabulary import (
    ClassType,
    ListType,
    NumberType,
    PlainType,
    ValueType,
    VectorType,
    Vocabulary,
)
from skillc_runtime.world.values import Value, show

UNITS = {
    "Length": "m",
    "Area": "m^2",
    "Angle": "rad",
    "Time": "s",
    "Frequency": "Hz",
    "Speed": "m/s",
    "AngularSpeed": "rad/s",
    "Acceleration": "m/s^2",
    "Mass": "kg",
    "Force": "N",
    "Torque": "Nm",
    "Stiffness": "N/m",
    "RotationalStiffness": "Nm/rad",
}


def text_of(value: Value, type_: ValueType, vocabulary: Vocabulary) -> str:
    """Return a value as an author would write it: individuals by short name, numbers with their SI unit."""
    if isinstance(type_, ClassType) and isinstance(value, str):
        return vocabulary.short(value)
    if isinstance(type_, NumberType) and isinstance(value, int | float) and not isinstance(value, bool):
        return f"{value:g} {UNITS.get(type_.dimension, '')}".rstrip()
    if isinstance(type_, ListType) and isinstance(value, tuple) and len(value) > 3:
        return f"{len(value)} values"
    return show(value)


def name_of(type_: ValueType, vocabulary: Vocabulary) -> str:
    """Return a type's name as an author would write it."""
    match type_:
        case ClassType(iri=iri):
            return vocabulary.short(iri)
        case NumberType(dimension=dimension):
            return dimension
        case VectorType():
            return "Vector"
        case PlainType(name=name):
            return name
        case ListType(element=element):
            return f"[{name_of(element, vocabulary)}]"
        case _:
            assert_never(type_)


def bindings_text(
    bindings: Mapping[str, Value], parameters: Sequence[Parameter], vocabulary: Vocabulary
) -> dict[str, str]:
    """Return each bound parameter with its value as text, in the order of the parameters."""
    return {
        parameter.name: text_of(bindings[parameter.name], parameter.type, vocabulary)
        for parameter in parameters
        if parameter.name in bindings
    }
