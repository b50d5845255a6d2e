"""Single facts of a world, true or false, as things to ask about."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias, assert_never

from skillc_compiler.library.format_condition import format_class, format_property, format_relation
from skillc_runtime.world.expressions import EvaluationError, property_of
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.values import Value, show_stated


@dataclass(frozen=True, slots=True)
class Related:
    """The relation holds between two individuals, or does not."""

    subject: str
    relation: str
    object: str
    holds: bool = True


@dataclass(frozen=True, slots=True)
class Valued:
    """The property of the individual has the value that it has, or none."""

    individual: str
    property: str


@dataclass(frozen=True, slots=True)
class Typed:
    """The individual is of the class, or is not."""

    individual: str
    cls: str
    holds: bool = True


Fact: TypeAlias = Related | Valued | Typed


def fact_text(fact: Fact, state: WorldState) -> str:
    """Return a fact in the words of the language, as `not lab:Gripper-1 contain lab:Eraser-1`."""
    short = state.vocabulary.short
    match fact:
        case Related(subject, relation, object_, holds):
            return format_relation(short(subject), relation, short(object_), holds)
        case Valued(individual, property_):
            value = value_at(state, individual, property_)
            return format_property(short(individual), property_, show_stated(value))
        case Typed(individual, cls, holds):
            return format_class(short(individual), short(cls), holds)
        case _:
            assert_never(fact)


def value_at(state: WorldState, individual: str, property_: str) -> Value | None:
    """Return the value of a property, stored or computed; None where it has none or cannot be computed."""
    try:
        return property_of(state, individual, property_)
    except EvaluationError:
        return None
