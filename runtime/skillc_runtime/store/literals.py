"""Reads Turtle literals as values of a property's type."""

from __future__ import annotations

import math
import re
from decimal import Decimal, InvalidOperation
from difflib import get_close_matches

import pyoxigraph as ox

from skillc_model.format_type import SI_UNITS
from skillc_rdf.turtle.terms import XSD
from skillc_rdf.vocabulary.text_forms import FORMS
from skillc_rdf.vocabulary.types import (
    LITERAL,
    DirectionType,
    NumberType,
    PlainType,
    PropertyTerm,
    VectorType,
    local_name,
)
from skillc_runtime.motion.arrays import np
from skillc_runtime.world.state.terms import SKILLC
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.vectors import is_direction, is_too_large, parse_vector

INTEGERS = frozenset(
    XSD + name
    for name in (
        *("integer", "int", "long", "short", "byte", "nonNegativeInteger", "positiveInteger", "unsignedInt"),
        *("unsignedLong", "unsignedShort", "unsignedByte", "nonPositiveInteger", "negativeInteger"),
    )
)
NUMBERS = INTEGERS | {XSD + "decimal", XSD + "double", XSD + "float"}
TEXTS = frozenset({XSD + "string", "http://www.w3.org/1999/02/22-rdf-syntax-ns#langString", XSD + "anyURI"})
VECTORS = frozenset({XSD + "string", SKILLC + "Vector", SKILLC + "Direction"})
TOO_LARGE, SMALLER = "this number is too large", "write a smaller number"
MAX_INTEGER = 2**63
"""The absolute value of integers is smaller than this."""
_NUMBER = re.compile(r"\s*([+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)", re.DOTALL)


class LiteralError(ValueError):
    """A literal that is not a value of the property; `help` is a hint, `instead` the correct text if it is known."""

    def __init__(self, message: str, help_: str = "", instead: str | None = None) -> None:
        super().__init__(message)
        self.help, self.instead = help_, instead


def read_literal(literal: ox.Literal, term: PropertyTerm) -> Value:
    """Return the value of a literal; any numeric datatype is accepted for a number. LiteralError when it is invalid."""
    kind, text = literal.datatype.value, literal.value
    match term.type:
        case NumberType() if kind in NUMBERS:
            return _number(text)
        case PlainType("Int") if kind in NUMBERS and _number(text).is_integer():
            return _integer(text)
        case PlainType("Bool") if text in ("true", "false", "1", "0") and kind == XSD + "boolean":
            return text in ("true", "1")
        case PlainType("Text") if kind in TEXTS or kind == term.datatype:
            return _text(text, term)
        case VectorType() | DirectionType() if kind in VECTORS:
            return _vector(text, term.type)
        case _:
            help_, instead = _cure(literal, term)
            raise LiteralError(f"it takes {_expected(term)}, and this is {literal}", help_, instead)


def text_literal(text: str, term: PropertyTerm) -> ox.Literal:
    """Return the literal of a text property's value."""
    is_plain = term.datatype in ("", LITERAL)
    return ox.Literal(text) if is_plain else ox.Literal(text, datatype=ox.NamedNode(term.datatype))


def _text(text: str, term: PropertyTerm) -> str:
    form = FORMS.get(term.datatype)
    if form is not None and not form.fits(text):
        name = f"xsd:{local_name(term.datatype)}"
        raise LiteralError(f'"{text}" is no {name}', f'write it as in "{form.example}"^^{name}')
    return _one_of(text, term.values)


def _number(text: str) -> float:
    try:
        number = float(text)
    except ValueError as error:
        raise LiteralError(f"`{text}` is not a number") from error
    if math.isinf(number) and "inf" not in text.lower():
        raise LiteralError(TOO_LARGE, SMALLER)
    if not math.isfinite(number):
        raise LiteralError("NaN and infinity are no values")
    return number


def _integer(text: str) -> int:
    """Return the exact value of an integer in a text."""
    try:
        number = Decimal(text.strip())
    except InvalidOperation as error:
        raise LiteralError(f"`{text}` has too many digits", "write a whole number") from error
    if abs(number) >= MAX_INTEGER:
        raise LiteralError(TOO_LARGE, SMALLER)
    if number != int(number):
        raise LiteralError(f"`{text}` is not a whole number", "write a whole number")
    return int(number)


def _vector(text: str, type_: VectorType | DirectionType) -> Value:
    vector = parse_vector(text)
    if vector is None and is_too_large(text):
        raise LiteralError("a number of this vector is too large", SMALLER)
    if vector is None:
        raise LiteralError(f'"{text}" is not three numbers', 'write three numbers with spaces between them: "0 0 1"')
    if isinstance(type_, VectorType) or is_direction(vector):
        return vector
    length = float(np.linalg.norm(vector))
    near = " ".join(f"{part / length:.4g}" for part in vector) if length else "0 0 1"
    raise LiteralError(f'a direction is of length 1, and "{text}" is of length {length:g}', f'write "{near}"')


def _one_of(text: str, values: tuple[str, ...]) -> str:
    if not values or text in values:
        return text
    near = get_close_matches(text.lower(), [value.lower() for value in values], n=1)
    meant = next((value for value in values if near and value.lower() == near[0]), None)
    help_ = f'did you mean "{meant}"?' if meant is not None else ""
    raise LiteralError(
        f'it is one of {", ".join(values)}, and this is "{text}"', help_, f'"{meant}"' if meant is not None else None
    )


def _expected(term: PropertyTerm) -> str:
    match term.type:
        case NumberType():
            return "a number"
        case PlainType("Int"):
            return "a whole number"
        case PlainType("Bool"):
            return "true or false"
        case PlainType("Text") if term.datatype not in ("", LITERAL):
            return f"a text of the datatype {local_name(term.datatype)}"
        case PlainType("Text"):
            return "a text in quotes"
        case VectorType() | DirectionType():
            return "three numbers in quotes"
        case _:
            return "a computed value that no file can state"


def _cure(literal: ox.Literal, term: PropertyTerm) -> tuple[str, str | None]:
    """Return a hint for a literal of the wrong type, and the correct text if it is obvious."""
    text = literal.value
    match term.type:
        case NumberType(dimension):
            number = _NUMBER.fullmatch(text)
            unit = SI_UNITS.get(dimension)
            if number is None or number.group(2):
                return f"write the number alone; it counts {unit}" if unit else "write the number alone", None
            return f"write {number.group(1)}, without quotes", number.group(1)
        case PlainType("Bool"):
            word = text.strip().lower()
            return ("write true or false, without quotes", word if word in ("true", "false") else None)
        case PlainType("Text"):
            return f'write "{text}"', f'"{text}"'
        case VectorType() | DirectionType():
            return 'write three numbers with spaces between them, in quotes: "0 0 1"', None
        case _:
            return "", None
