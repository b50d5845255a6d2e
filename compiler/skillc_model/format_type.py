"""Types and quantities as text in the syntax of the language."""

from __future__ import annotations

from typing import assert_never

from skillc_rdf.vocabulary.types import (
    ClassType,
    DirectionType,
    ListType,
    NumberType,
    PlainType,
    ValueType,
    VectorType,
    Vocabulary,
)

SI_UNITS = {
    "Length": "m",
    "Area": "m2",
    "Angle": "rad",
    "Time": "s",
    "Frequency": "Hz",
    "Speed": "m/s",
    "AngularSpeed": "rad/s",
    "Acceleration": "m/s2",
    "Mass": "kg",
    "Force": "N",
    "Torque": "Nm",
    "Stiffness": "N/m",
    "RotationalStiffness": "Nm/rad",
}
"""The SI unit of each dimension, as the language writes it."""


def format_type(type_: ValueType, vocabulary: Vocabulary) -> str:
    """Return the type in the syntax of the language."""
    match type_:
        case ClassType(iri=iri):
            return vocabulary.short(iri)
        case NumberType(dimension=dimension):
            return dimension
        case VectorType(dimension=dimension):
            return "Vector" if dimension == "Number" else f"Vector of {dimension}"
        case DirectionType():
            return "Direction"
        case PlainType(name=name):
            return name
        case ListType(element=element):
            return f"[{format_type(element, vocabulary)}]"
        case _:
            assert_never(type_)


def format_quantity(value: float, type_: ValueType) -> str:
    """Return a number in SI units as text with the unit of its type, if it has one."""
    unit = SI_UNITS.get(type_.dimension, "") if isinstance(type_, NumberType) else ""
    return f"{value:g} {unit}".strip()
