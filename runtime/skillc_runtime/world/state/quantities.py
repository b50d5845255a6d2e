"""Formats values for messages: numbers with units, angles in degrees, and placeholders for values to fill in."""

from __future__ import annotations

import math

from skillc_model.format_type import SI_UNITS, format_quantity
from skillc_rdf.vocabulary.types import NumberType, PlainType, PropertyTerm, ValueType
from skillc_runtime.world.state.values import Value, show

IN_DEGREES = {"Angle": "deg", "AngularSpeed": "deg/s"}
"""The units of the dimensions that people give in degrees."""


def show_quantity(value: Value, type_: ValueType | None) -> str:
    """Return a value as text, a number with the unit of its type; without one if the type is not known."""
    if not isinstance(type_, NumberType) or not isinstance(value, int | float) or isinstance(value, bool):
        return show(value)
    unit = IN_DEGREES.get(type_.dimension)
    return format_quantity(value, type_) if unit is None else f"{math.degrees(value):g} {unit}"


def placeholder(term: PropertyTerm) -> str:
    """Return a placeholder for the value of a property, such as `NUMBER-IN-m`."""
    match term.type:
        case NumberType(dimension):
            return f"NUMBER-IN-{SI_UNITS[dimension]}" if dimension in SI_UNITS else "NUMBER"
        case PlainType("Bool"):
            return "true"
        case _:
            return f'"{term.values[0]}"' if term.values else '"TEXT"'
