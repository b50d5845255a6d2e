"""Names, types and values as written."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_dsl.source import Span


class Name(msgspec.Struct, frozen=True):
    """A bare (`contain`) or qualified (`skiros:contain`) name."""

    text: str
    span: Span


class ListOf(msgspec.Struct, frozen=True):
    """The type `[T]`."""

    element: TypeName
    span: Span


class OfDimension(msgspec.Struct, frozen=True):
    """The type `Vector of Length`; anything else before `of` is not a type."""

    of: Name
    dimension: Name
    span: Span


TypeName: TypeAlias = Name | OfDimension | ListOf


class Quantity(msgspec.Struct, frozen=True):
    """A number with its unit as written: `400 N/m`."""

    value: float
    unit: str
    span: Span


class Number(msgspec.Struct, frozen=True):
    """A bare number; `text` distinguishes `2` from `2.0`."""

    value: float
    text: str
    span: Span


class Text(msgspec.Struct, frozen=True):
    """A string literal, without its quotes."""

    value: str
    span: Span


class Message(msgspec.Struct, frozen=True):
    """A string literal with values, `"{force} is too much"`, by its parts: text, and names in braces."""

    text: str
    parts: tuple[str | NameReference, ...]
    span: Span

    @property
    def names(self) -> tuple[NameReference, ...]:
        """The names in it."""
        return tuple(part for part in self.parts if not isinstance(part, str))


class Boolean(msgspec.Struct, frozen=True):
    """`true` or `false`."""

    value: bool
    span: Span


class NameReference(msgspec.Struct, frozen=True):
    """A name where a value is expected: a parameter, a let, an individual or an enumeration value."""

    name: Name
    span: Span


class Member(msgspec.Struct, frozen=True):
    """`of.property`"""

    of: Value
    property: Name
    span: Span


class Invoke(msgspec.Struct, frozen=True):
    """`function(argument, ..)`"""

    function: Name
    arguments: tuple[Value, ...]
    span: Span


class Arithmetic(msgspec.Struct, frozen=True):
    """`left + right` and its like."""

    operator: Literal["+", "-", "*", "/"]
    left: Value
    right: Value
    span: Span


class ListValue(msgspec.Struct, frozen=True):
    """`[item, ..]`"""

    items: tuple[Value, ...]
    span: Span


Value: TypeAlias = Quantity | Number | Text | Boolean | NameReference | Member | Invoke | Arithmetic | ListValue
