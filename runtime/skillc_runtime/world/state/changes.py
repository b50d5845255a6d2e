"""What can change in the world: the closed set of writes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias, assert_never

from skillc_runtime.world.state.values import Value


@dataclass(frozen=True, slots=True)
class AddIndividual:
    """The individual exists and is of the classes, beside those it has already."""

    individual: str
    types: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class RemoveIndividual:
    """The individual and all facts about it are gone."""

    individual: str


@dataclass(frozen=True, slots=True)
class AddRelation:
    """The relation holds; a functional one loses its former value, an inverse functional one its former holder."""

    subject: str
    relation: str
    object: str


@dataclass(frozen=True, slots=True)
class RemoveRelation:
    """The relation does not hold: every assertion that says so is retracted, of sub-relations and inverses too."""

    subject: str
    relation: str
    object: str


@dataclass(frozen=True, slots=True)
class SetProperty:
    """The property has this value and no other; a tuple gives several values to one that is not functional."""

    individual: str
    property: str
    value: Value


@dataclass(frozen=True, slots=True)
class ClearProperty:
    """The property has no value."""

    individual: str
    property: str


Change: TypeAlias = AddIndividual | RemoveIndividual | AddRelation | RemoveRelation | SetProperty | ClearProperty


def named_individuals(change: Change) -> tuple[str, ...]:
    """Return the individuals that a change names: whatever else it retracts is a fact about one of them."""
    match change:
        case AddRelation(subject, _, object_) | RemoveRelation(subject, _, object_):
            return subject, object_
        case AddIndividual(individual, _) | RemoveIndividual(individual):
            return (individual,)
        case SetProperty(individual, _, _) | ClearProperty(individual, _):
            return (individual,)
        case _:
            assert_never(change)
