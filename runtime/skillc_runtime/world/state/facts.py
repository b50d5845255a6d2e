"""Single facts of a world, true or false, as things to ask about."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias, assert_never

from skillc_compiler.library.vocabulary import local_name
from skillc_runtime.world.state.properties import value_at
from skillc_runtime.world.state.values import show
from skillc_runtime.world.state.world_state import WorldState


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
            return f"{'' if holds else 'not '}{short(subject)} {local_name(relation)} {short(object_)}"
        case Valued(individual, property_):
            value = value_at(state, individual, property_)
            if value is None or (isinstance(value, tuple) and not value):
                return f"not {short(individual)} has {local_name(property_)}"
            return f"{short(individual)}.{local_name(property_)} == {show(value)}"
        case Typed(individual, cls, holds):
            return f"{'' if holds else 'not '}{short(individual)} is {short(cls)}"
        case _:
            assert_never(fact)
