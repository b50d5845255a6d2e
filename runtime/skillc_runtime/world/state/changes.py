"""The changes that a write to the world can consist of, a closed union."""

from __future__ import annotations

from typing import TypeAlias, assert_never

import msgspec

from skillc_runtime.world.state.values import Value


class AddIndividual(msgspec.Struct, frozen=True):
    """The individual exists and is of these classes, in addition to those it has already."""

    individual: str
    types: tuple[str, ...]


class RemoveIndividual(msgspec.Struct, frozen=True):
    """The individual does not exist, and no facts about it."""

    individual: str


class AddRelation(msgspec.Struct, frozen=True):
    """The relation holds; a functional one loses its former value, an inverse functional one its former holder."""

    subject: str
    relation: str
    object: str


class RemoveRelation(msgspec.Struct, frozen=True):
    """The relation does not hold: all assertions that imply it are retracted, also of sub-relations and inverses."""

    subject: str
    relation: str
    object: str


class SetProperty(msgspec.Struct, frozen=True):
    """The property has this value only; a tuple states several values of a property that is not functional."""

    individual: str
    property: str
    value: Value


class ClearProperty(msgspec.Struct, frozen=True):
    """The property has no value."""

    individual: str
    property: str


Change: TypeAlias = AddIndividual | RemoveIndividual | AddRelation | RemoveRelation | SetProperty | ClearProperty


def named_individuals(change: Change) -> tuple[str, ...]:
    """Return the individuals that a change names; other facts that it retracts are about one of them, too."""
    match change:
        case AddRelation(subject, _, object_) | RemoveRelation(subject, _, object_):
            return subject, object_
        case AddIndividual(individual, _) | RemoveIndividual(individual):
            return (individual,)
        case SetProperty(individual, _, _) | ClearProperty(individual, _):
            return (individual,)
        case _:
            assert_never(change)
