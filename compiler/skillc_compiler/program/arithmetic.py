"""The types of sums, differences, products and quotients."""

from __future__ import annotations

from skillc_compiler.program.types import INT, UNKNOWN, Direction, Measure, Type, Vector
from skillc_dsl.units import NUMBER, TEMPERATURE, sum_dimension


def arithmetic_type(operator: str, left: Type, right: Type) -> Type | None:
    """Return the type of `left operator right`, None if the operator does not apply to such values."""
    if UNKNOWN in (left, right):
        return UNKNOWN
    if (left, right) == (INT, INT) and operator != "/":
        return INT
    match operator, as_number_type(left), as_number_type(right):
        case "+" | "-", Measure(one), Measure(other):
            joined = sum_dimension(operator, one, other)
            return None if joined is None else Measure(joined)
        case "+" | "-", Vector(one), Vector(other):
            joined = sum_dimension(operator, one, other)
            return None if joined is None else Vector(joined)
        case _, Measure(one) | Vector(one), Measure(other) | Vector(other) if TEMPERATURE in (one, other):
            return None
        case "*", Measure(one), Measure(other):
            return Measure(one * other)
        case "/", Measure(one), Measure(other):
            return Measure(one / other)
        case ("*", Vector(one), Measure(other)) | ("*", Measure(one), Vector(other)):
            return Vector(one * other)
        case "/", Vector(one), Measure(other):
            return Vector(one / other)
    return None


def as_number_type(kind: Type) -> Type:
    """Return the type for arithmetic: an integer is a number, a direction a dimensionless vector."""
    match kind:
        case Direction():
            return Vector(NUMBER)
        case _:
            return Measure(NUMBER) if kind == INT else kind
