"""Expressions and conditions as the runtime evaluates them, and the effects of skills."""

from __future__ import annotations

from typing import Literal as OneOf
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


class Tolerance(msgspec.Struct, frozen=True):
    """By how much a number may differ: by a share of it if `relative`, else by an amount in SI units."""

    amount: float
    relative: bool


class Adjust(msgspec.Struct, frozen=True, tag="adjust"):
    """The number is between `low` and `high` afterwards, which are read in the state before; None is no bound.

    It is exactly the value that both are, if they are the same. By `tolerance` what is sensed of it may differ.
    """

    subject: Variable | Individual
    property: str
    low: Expression | None
    high: Expression | None
    tolerance: Tolerance | None = None


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
            exact, tolerance = exact_value(effect), effect.tolerance
            if exact is not None and tolerance is None:
                return Compare(number, "==", exact)
            least = () if low is None else (_at_bound(number, ">=", low, tolerance),)
            most = () if high is None else (_at_bound(number, "<=", high, tolerance),)
            return And((HasProperty(subject, property_), *least, *most))
        case _:
            assert_never(effect)


def _at_bound(
    number: PropertyOf, operator: OneOf["<=", ">="], bound: Expression, tolerance: Tolerance | None
) -> Condition:
    """Return that a number is above or below a bound, or beyond it by no more than a tolerance."""
    if tolerance is None:
        return Compare(number, operator, bound)
    if not tolerance.relative:
        away = Arithmetic("-" if operator == ">=" else "+", bound, Literal(tolerance.amount))
        return Compare(number, operator, away)
    shares = (1.0 - tolerance.amount, 1.0 + tolerance.amount)  # one of them is away from zero
    return Or(tuple(Compare(number, operator, Arithmetic("*", bound, Literal(each))) for each in shares))
