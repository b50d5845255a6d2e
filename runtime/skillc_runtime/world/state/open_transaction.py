"""Collects the writes of a transaction, by the names that people write."""

from __future__ import annotations

from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
)
from skillc_runtime.world.state.consistency.axiom_violations import unknown_term
from skillc_runtime.world.state.names import expand_name
from skillc_runtime.world.state.templates import Templates
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


class OpenTransaction:
    """Changes of a world that are not committed yet; axioms are checked at the commit.

    Names are IRIs or `prefix:name`; NoSuchName for an unknown prefix, ValueError for an unknown term.
    """

    def __init__(self, state: WorldState) -> None:
        self._start = state
        self._state = state
        self.changes: list[Change] = []

    @property
    def state(self) -> WorldState:
        """The version after the changes so far, unchecked."""
        return self._state

    def create(self, individual: str, *classes: str) -> str:
        """Add an individual of these classes, or add the classes to an existing one; return its IRI."""
        iri = self._iri(individual)
        self.add(AddIndividual(iri, tuple(map(self._iri, classes))))
        return iri

    def instantiate(self, templates: Templates, template: str, individual: str) -> str:
        """Add an individual with all facts of a template; return its IRI.

        NoSuchName when there is no such template; ValueError when the individual exists already.
        """
        iri = self._iri(individual)
        self.add(*templates.instance(template, iri, self._state))
        return iri

    def relate(self, subject: str, relation: str, object_: str) -> None:
        """Add a relation; a functional one loses its former object, an inverse functional one its former subject."""
        self.add(AddRelation(self._iri(subject), self._iri(relation), self._iri(object_)))

    def unrelate(self, subject: str, relation: str, object_: str) -> None:
        """Remove a relation, also where a sub-relation or an inverse asserts it."""
        self.add(RemoveRelation(self._iri(subject), self._iri(relation), self._iri(object_)))

    def set(self, individual: str, property_: str, value: Value) -> None:
        """Set a property to this value only; numbers in SI units."""
        self.add(SetProperty(self._iri(individual), self._iri(property_), value))

    def clear(self, individual: str, property_: str) -> None:
        """Remove all values of a property."""
        self.add(ClearProperty(self._iri(individual), self._iri(property_)))

    def remove(self, individual: str) -> None:
        """Remove an individual with all facts about it."""
        self.add(RemoveIndividual(self._iri(individual)))

    def add(self, *changes: Change) -> None:
        """Append changes."""
        short = self._start.vocabulary.short
        unknown = [iri for change in changes if (iri := unknown_term(self._start, change)) is not None]
        if unknown:
            raise ValueError(f"there is no relation or property {short(unknown[0])}")
        self._state = self._state.with_changes(changes)
        self.changes += changes

    def _iri(self, name: str) -> str:
        return expand_name(name, self._start.vocabulary)
