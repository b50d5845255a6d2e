"""Conditions as written."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from skillc_dsl.source import Span
from skillc_dsl.syntax.values import Name, Value

CompareOperator: TypeAlias = Literal["==", "!=", "<", "<=", ">", ">="]


@dataclass(frozen=True, slots=True)
class Anything:
    """`_`: some individual, whichever."""

    span: Span


@dataclass(frozen=True, slots=True)
class Relation:
    """`subject relation object`"""

    subject: Value | Anything
    relation: Name
    object: Value | Anything
    span: Span


@dataclass(frozen=True, slots=True)
class Compare:
    """`left == right` and its like, on property values or on individuals."""

    left: Value
    operator: CompareOperator
    right: Value
    span: Span


@dataclass(frozen=True, slots=True)
class Has:
    """`subject has property`"""

    subject: Value
    property: Name
    span: Span


@dataclass(frozen=True, slots=True)
class Is:
    """`subject is Class`"""

    subject: Value
    cls: Name
    span: Span


@dataclass(frozen=True, slots=True)
class Given:
    """`given parameter`"""

    parameter: Name
    span: Span


@dataclass(frozen=True, slots=True)
class Not:
    """`not body`"""

    body: Condition
    span: Span


@dataclass(frozen=True, slots=True)
class And:
    """`left and right`, flattened."""

    parts: tuple[Condition, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Or:
    """`left or right`, flattened."""

    parts: tuple[Condition, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Implies:
    """`if_ implies then`"""

    if_: Condition
    then: Condition
    span: Span


@dataclass(frozen=True, slots=True)
class Quantified:
    """`exists x: Class (body)` or `forall x: Class (body)`."""

    quantifier: Literal["exists", "forall"]
    variable: Name
    cls: Name
    body: Condition
    span: Span


@dataclass(frozen=True, slots=True)
class Bare:
    """A value standing where a condition belongs, such as `surface.isClean`; kept so that a check can explain it."""

    value: Value
    span: Span


Condition: TypeAlias = Relation | Compare | Has | Is | Given | Not | And | Or | Implies | Quantified | Bare
