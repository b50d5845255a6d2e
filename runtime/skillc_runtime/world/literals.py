"""Turtle literals as values of a property's type."""

from __future__ import annotations

import math

import pyoxigraph as ox

from skillc_compiler.library.vocabulary import NumberType, PlainType, PropertyTerm
from skillc_runtime.world.values import Value

XSD = "http://www.w3.org/2001/XMLSchema#"
INTEGERS = frozenset(
    XSD + name
    for name in (
        *("integer", "int", "long", "short", "byte", "nonNegativeInteger", "positiveInteger", "unsignedInt"),
        *("unsignedLong", "unsignedShort", "unsignedByte", "nonPositiveInteger", "negativeInteger"),
    )
)
NUMBERS = INTEGERS | {XSD + "decimal", XSD + "double", XSD + "float"}
TEXTS = frozenset({XSD + "string", "http://www.w3.org/1999/02/22-rdf-syntax-ns#langString", XSD + "anyURI"})


class LiteralError(ValueError):
    """A literal that is no value of the property; the message says what the property takes."""


def read(literal: ox.Literal, term: PropertyTerm) -> Value:
    """Return the value of a literal: any numeric datatype for a number, compared by value afterwards."""
    kind, text = literal.datatype.value, literal.value
    match term.type:
        case NumberType() if kind in NUMBERS:
            return _number(text)
        case PlainType("Int") if kind in NUMBERS and _number(text).is_integer():
            return int(_number(text))
        case PlainType("Bool") if text in ("true", "false", "1", "0") and kind == XSD + "boolean":
            return text in ("true", "1")
        case PlainType("Text") if kind in TEXTS:
            return text
        case _:
            raise LiteralError(f"it takes {_expected(term)}, and this is {literal}")


def _number(text: str) -> float:
    try:
        number = float(text)
    except ValueError as error:
        raise LiteralError(f"`{text}` is no number") from error
    if not math.isfinite(number):
        raise LiteralError("NaN and infinity are no values")
    return number


def _expected(term: PropertyTerm) -> str:
    match term.type:
        case NumberType():
            return "a number"
        case PlainType("Int"):
            return "a whole number"
        case PlainType("Bool"):
            return "true or false"
        case PlainType("Text"):
            return "a text in quotes"
        case _:
            return "a computed value that no file can state"
