"""Names, types and values as written."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from skillc_dsl.source import Span


@dataclass(frozen=True, slots=True)
class Name:
    """A bare (`contain`) or qualified (`skiros:contain`) name."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class ListOf:
    """The type `[T]`."""

    element: TypeName
    span: Span


@dataclass(frozen=True, slots=True)
class OfDimension:
    """The type `Vector of Length`; anything else before `of` is not a type."""

    of: Name
    dimension: Name
    span: Span


TypeName: TypeAlias = Name | OfDimension | ListOf


@dataclass(frozen=True, slots=True)
class Quantity:
    """A number with its unit as written: `400 N/m`."""

    value: float
    unit: str
    span: Span


@dataclass(frozen=True, slots=True)
class Number:
    """A bare number; `text` distinguishes `2` from `2.0`."""

    value: float
    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class Text:
    """A string literal, without its quotes."""

    value: str
    span: Span


@dataclass(frozen=True, slots=True)
class Boolean:
    """`true` or `false`."""

    value: bool
    span: Span


@dataclass(frozen=True, slots=True)
class NameReference:
    """A name where a value is expected: a parameter, a let, an individual or an enumeration value."""

    name: Name
    span: Span


@dataclass(frozen=True, slots=True)
class Member:
    """`of.property`"""

    of: Value
    property: Name
    span: Span


@dataclass(frozen=True, slots=True)
class Invoke:
    """`function(argument, ..)`"""

    function: Name
    arguments: tuple[Value, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Arithmetic:
    """`left + right` and its like."""

    operator: Literal["+", "-", "*", "/"]
    left: Value
    right: Value
    span: Span


Value: TypeAlias = Quantity | Number | Text | Boolean | NameReference | Member | Invoke | Arithmetic
