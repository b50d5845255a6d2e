"""Types and quantities as text in the syntax of the language."""

from __future__ import annotations

from decimal import Decimal
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
    "Energy": "J",
    "Power": "W",
    "Current": "A",
    "Voltage": "V",
    "Volume": "m3",
    "Flow": "m3/s",
    "Pressure": "Pa",
    "Temperature": "K",
    "TemperatureDifference": "K",
}
"""The SI unit of each dimension, in which scenes and the runtime have its values."""

_ZERO_CELSIUS = Decimal("273.15")
"""0 degC in K."""


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


def in_written_unit(value: float, dimension: str) -> tuple[float, str]:
    """Return a number in SI units as the language writes it: the number and its unit, "" for none."""
    if dimension == "Temperature":
        return float(Decimal(repr(float(value))) - _ZERO_CELSIUS), "degC"
    return value, SI_UNITS.get(dimension, "")


def format_quantity(value: float, type_: ValueType) -> str:
    """Return a number in SI units as text with the unit of its type, if it has one."""
    number, unit = in_written_unit(value, type_.dimension if isinstance(type_, NumberType) else "")
    return f"{number:g} {unit}".strip()
