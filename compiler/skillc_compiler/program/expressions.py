"""Typed expressions and conditions: each with its meaning, and its place in the source."""

from __future__ import annotations

import msgspec

from skillc_compiler.program.types import Thing, Type
from skillc_dsl import syntax as s
from skillc_dsl.source import Span
from skillc_model.conditions import (
    Anything,
    Condition,
    Expression,
    HasProperty,
    Holds,
    Individual,
    PropertyOf,
    Variable,
)
from skillc_rdf.vocabulary.types import Bounds


class TypedExpression(msgspec.Struct, frozen=True):
    """An expression: its meaning, its type, its place, its operands and the conditions in it.

    `_` is a variable of that name. `declared` is the place of the name that it refers to, if it is one.
    """

    meaning: Expression
    type: Type
    span: Span
    parts: tuple[TypedExpression, ...] = ()
    declared: Span | None = None
    conditions: tuple[TypedCondition, ...] = ()

    @property
    def known(self) -> Condition | None:
        """The condition that a property of a thing has a value, or a functional relation leads somewhere; else None."""
        match self.meaning:
            case PropertyOf(of=Variable() | Individual() as of, property=iri):
                return Holds(of, iri, Anything()) if isinstance(self.type, Thing) else HasProperty(of, iri)
            case _:
                return None


class EffectScope(msgspec.Struct, frozen=True):
    """The variable, with its class, of an effect on all individuals that fulfil a condition."""

    variable: str
    cls: str


class NumberChange(msgspec.Struct, frozen=True):
    """A change of a number by an amount, or to it, between `low` and `high`; None where it is open (`_`).

    `bounds` are those of the property.
    """

    operator: s.ChangeOperator
    of: TypedExpression
    low: TypedExpression | None
    high: TypedExpression | None
    bounds: Bounds | None


class TypedCondition(msgspec.Struct, frozen=True):
    """A condition: its meaning, its place, the expressions in it and its parts.

    `conditional` if it is an effect on those individuals of which its second part held at the start, `change` if it is
    one on a number: it claims nothing of the end alone, so that it means what always holds.
    """

    meaning: Condition
    span: Span
    values: tuple[TypedExpression, ...] = ()
    parts: tuple[TypedCondition, ...] = ()
    conditional: EffectScope | None = None
    change: NumberChange | None = None

    @property
    def is_effect(self) -> bool:
        """Whether it says what happens, from which nothing follows for one state alone."""
        return self.conditional is not None or self.change is not None
