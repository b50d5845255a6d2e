"""Values and conditions as written: each may stand in the other."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_dsl.source import Span
from skillc_dsl.syntax.names import Name

CompareOperator: TypeAlias = Literal["==", "!=", "<", "<=", ">", ">="]
ChangeOperator: TypeAlias = Literal["+=", "-=", ":="]


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
    """A string literal with values, `"{force} is too much"`, by its parts: text, and names or members in braces."""

    text: str
    parts: tuple[str | NameReference | Member, ...]
    span: Span

    @property
    def values(self) -> tuple[NameReference | Member, ...]:
        """The values in it."""
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


class Aggregate(msgspec.Struct, frozen=True):
    """`function(variable: Class where condition, value)`, such as `sum(x: Part where tray contain x, x.mass)`."""

    function: Name
    variable: Name
    cls: Name
    where: Condition | None
    value: Value | None
    span: Span


Value: TypeAlias = (
    Quantity | Number | Text | Boolean | NameReference | Member | Invoke | Arithmetic | ListValue | Aggregate
)


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


class Change(msgspec.Struct, frozen=True):
    """`property += amount`, `-=` or `:=`, in a post; `to` is the other end of `amount .. to`."""

    property: Value
    operator: ChangeOperator
    amount: Value | Anything
    to: Value | Anything | None
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
    """`exists x: Class (body)` or `forall x: Class (body)`; in a post also `forall x: Class (body when when)`.

    One with several variables has one in its body for all but the first, with the same place.
    """

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


Condition: TypeAlias = Relation | Compare | Change | Has | Is | Given | Not | And | Or | Implies | Quantified | Bare
