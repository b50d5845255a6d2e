"""Names and types as written."""

from __future__ import annotations

from typing import TypeAlias

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
