"""Conditions as written."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_dsl.source import Span
from skillc_dsl.syntax.values import Name, Value

CompareOperator: TypeAlias = Literal["==", "!=", "<", "<=", ">", ">="]


class Anything(msgspec.Struct, frozen=True):
    """`_`: some individual, whichever."""

    span: Span


class Relation(msgspec.Struct, frozen=True):
    """`subject relation object`"""

    subject: Value | Anything
    relation: Name
    object: Value | Anything
    span: Span


class Compare(msgspec.Struct, frozen=True):
    """`left == right` and its like, on property values or on individuals."""

    left: Value
    operator: CompareOperator
    right: Value
    span: Span


class Has(msgspec.Struct, frozen=True):
    """`subject has property`"""

    subject: Value
    property: Name
    span: Span


class Is(msgspec.Struct, frozen=True):
    """`subject is Class`"""

    subject: Value
    cls: Name
    span: Span


class Given(msgspec.Struct, frozen=True):
    """`given parameter`"""

    parameter: Name
    span: Span


class Not(msgspec.Struct, frozen=True):
    """`not body`"""

    body: Condition
    span: Span


class And(msgspec.Struct, frozen=True):
    """`left and right`, flattened."""

    parts: tuple[Condition, ...]
    span: Span


class Or(msgspec.Struct, frozen=True):
    """`left or right`, flattened."""

    parts: tuple[Condition, ...]
    span: Span


class Implies(msgspec.Struct, frozen=True):
    """`if_ implies then`"""

    if_: Condition
    then: Condition
    span: Span


class Quantified(msgspec.Struct, frozen=True):
    """`exists x: Class (body)` or `forall x: Class (body)`; in a post also `forall x: Class (body when when)`."""

    quantifier: Literal["exists", "forall"]
    variable: Name
    cls: Name
    body: Condition
    span: Span
    when: Condition | None = None


class Bare(msgspec.Struct, frozen=True):
    """A value standing where a condition belongs, such as `surface.isClean`; kept so that a check can explain it."""

    value: Value
    span: Span


Condition: TypeAlias = Relation | Compare | Has | Is | Given | Not | And | Or | Implies | Quantified | Bare
