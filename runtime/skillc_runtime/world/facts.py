"""Single facts of a world, true or false, as things to ask about."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from skillc_runtime.world.expressions import EvaluationError, property_of
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.values import Value


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


def value_at(state: WorldState, individual: str, property_: str) -> Value | None:
    """Return the value of a property, stored or computed; None where it has none or cannot be computed."""
    try:
        return property_of(state, individual, property_)
    except EvaluationError:
        return None
