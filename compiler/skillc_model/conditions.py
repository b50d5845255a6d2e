"""Expressions and conditions as the runtime evaluates them, and the effects of skills."""

from __future__ import annotations

from typing import TypeAlias, assert_never

import msgspec

from skillc_rdf.vocabulary.conditions import Aggregate as Aggregate
from skillc_rdf.vocabulary.conditions import And as And
from skillc_rdf.vocabulary.conditions import Anything as Anything
from skillc_rdf.vocabulary.conditions import Arithmetic as Arithmetic
from skillc_rdf.vocabulary.conditions import Compare as Compare
from skillc_rdf.vocabulary.conditions import Condition as Condition
from skillc_rdf.vocabulary.conditions import Exists as Exists
from skillc_rdf.vocabulary.conditions import Expression as Expression
from skillc_rdf.vocabulary.conditions import Forall as Forall
from skillc_rdf.vocabulary.conditions import Given as Given
from skillc_rdf.vocabulary.conditions import HasProperty as HasProperty
from skillc_rdf.vocabulary.conditions import Holds as Holds
from skillc_rdf.vocabulary.conditions import Individual as Individual
from skillc_rdf.vocabulary.conditions import Invoke as Invoke
from skillc_rdf.vocabulary.conditions import IsA as IsA
from skillc_rdf.vocabulary.conditions import ListValue as ListValue
from skillc_rdf.vocabulary.conditions import Literal as Literal
from skillc_rdf.vocabulary.conditions import Message as Message
from skillc_rdf.vocabulary.conditions import NamedValue as NamedValue
from skillc_rdf.vocabulary.conditions import Not as Not
from skillc_rdf.vocabulary.conditions import Operator as Operator
from skillc_rdf.vocabulary.conditions import Or as Or
from skillc_rdf.vocabulary.conditions import PropertyOf as PropertyOf
from skillc_rdf.vocabulary.conditions import Same as Same
from skillc_rdf.vocabulary.conditions import Term as Term
from skillc_rdf.vocabulary.conditions import Variable as Variable


class Assert(msgspec.Struct, frozen=True, tag="assert"):
    """The relation holds afterwards; a functional relation loses its former value."""

    subject: Variable | Individual
    relation: str
    object: Variable | Individual


class Retract(msgspec.Struct, frozen=True, tag="retract"):
    """The relation does not hold afterwards; `_` retracts it for every individual."""

    subject: Term
    relation: str
    object: Term


class Assign(msgspec.Struct, frozen=True, tag="assign"):
    """The property has this value afterwards and no other."""

    subject: Variable | Individual
    property: str
    value: Expression


class Adjust(msgspec.Struct, frozen=True, tag="adjust"):
    """The number is between `low` and `high` afterwards, which are read in the state before; None is no bound.

    It is exactly the value that both are, if they are the same.
    """

    subject: Variable | Individual
    property: str
    low: Expression | None
    high: Expression | None


SingleEffect: TypeAlias = Assert | Retract | Assign | Adjust


class ForEach(msgspec.Struct, frozen=True, tag="for each"):
    """The effect happens to each individual of the class, called `variable`, of which the condition held before."""

    variable: str
    cls: str
    when: Condition
    effect: SingleEffect


Effect: TypeAlias = SingleEffect | ForEach


def single_effect(effect: Effect) -> SingleEffect:
    """Return what an effect does to one individual."""
    return effect.effect if isinstance(effect, ForEach) else effect


def exact_value(effect: Adjust) -> Expression | None:
    """Return which value a number has afterwards; None if only bounds of it are known."""
    return effect.low if effect.low == effect.high else None


def bounds_of(effect: SingleEffect) -> tuple[Expression, ...]:
    """Return the expressions that are read in the state before; none unless the effect changes a number."""
    bounds = (effect.low, effect.high) if isinstance(effect, Adjust) else ()
    return tuple(each for each in bounds if each is not None)


def wanted_by(effect: SingleEffect) -> Condition:
    """Return the condition that an effect makes true; the bounds of a number in it are read in the state before."""
    match effect:
        case Assert(subject, relation, object_):
            return Holds(subject, relation, object_)
        case Retract(subject, relation, object_):
            return Not(Holds(subject, relation, object_))
        case Assign(subject, property_, value):
            return Compare(PropertyOf(subject, property_), "==", value)
        case Adjust(subject, property_, low, high):
            number = PropertyOf(subject, property_)
            exact = exact_value(effect)
            if exact is not None:
                return Compare(number, "==", exact)
            least = () if low is None else (Compare(number, ">=", low),)
            most = () if high is None else (Compare(number, "<=", high),)
            return And((HasProperty(subject, property_), *least, *most))
        case _:
            assert_never(effect)
