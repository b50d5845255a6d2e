"""Computes the changes that lead from one version of a world to another."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
    named_individuals,
)
from skillc_runtime.world.state.facts import IriTriple
from skillc_runtime.world.state.values import Value, are_equal
from skillc_runtime.world.state.world_state import WorldState


def changes_between(before: WorldState, after: WorldState, about: Iterable[str] | None = None) -> tuple[Change, ...]:
    """Return the changes from `before` to `after`, two valid versions with one vocabulary, in a fixed order.

    Only facts about the individuals `about` are compared; by default, all facts.
    """
    individuals = sorted(before.individuals | after.individuals if about is None else set(about))
    existing = list(_individual_changes(before, after, individuals))
    lost = _asserted_relations(before, individuals) - _asserted_relations(after, individuals)
    changes = [*existing, *(RemoveRelation(*fact) for fact in sorted(lost))]
    midway = before.with_changes(changes)
    missing = _asserted_relations(after, individuals) - _asserted_relations(midway, individuals)
    return (*changes, *(AddRelation(*fact) for fact in sorted(missing)), *_property_changes(midway, after, individuals))


def changes_back(changes: Iterable[Change], before: WorldState, after: WorldState) -> tuple[Change, ...]:
    """Return the changes from `after` back to `before`, from which `changes` led."""
    return changes_between(after, before, {each for change in changes for each in named_individuals(change)})


def _individual_changes(before: WorldState, after: WorldState, individuals: Iterable[str]) -> Iterator[Change]:
    """Yield the changes of classes; an individual that loses a class is removed and added again."""
    for individual in individuals:
        former, present = before.types(individual), after.types(individual)
        if not former <= present:
            yield RemoveIndividual(individual)
        if present and former != present:
            yield AddIndividual(individual, tuple(sorted(present)))


def _asserted_relations(state: WorldState, individuals: Iterable[str]) -> set[IriTriple]:
    """Return the asserted relations from and to the individuals."""
    return {
        fact
        for relation, links in state.asserted.items()
        if links.forward
        for individual in individuals
        for fact in (
            *((individual, relation, other) for other in links.forward.get(individual)),
            *((other, relation, individual) for other in links.backward.get(individual)),
        )
    }


def _property_changes(before: WorldState, after: WorldState, individuals: Iterable[str]) -> Iterator[Change]:
    for property_, table in sorted(after.stored.items()):
        former = before.stored[property_]
        for individual in individuals:
            old, new = former.get(individual), table.get(individual)
            if new is None and old is not None:
                yield ClearProperty(individual, property_)
            elif new is not None and not _are_identical(old, new):
                yield SetProperty(individual, property_, new)


def _are_identical(one: Value | None, other: Value) -> bool:
    return one is other or (one is not None and type(one) is type(other) and are_equal(one, other))
