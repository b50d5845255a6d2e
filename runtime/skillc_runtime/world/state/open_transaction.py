"""Writes that are gathered to be made all together, in the words of those who write."""

from __future__ import annotations

from skillc_runtime.world.state.axiom_violations import unknown_term
from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
)
from skillc_runtime.world.state.names import expand_name
from skillc_runtime.world.state.templates import Templates
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


class OpenTransaction:
    """Changes of a world that nobody else sees yet; whether the axioms allow them is looked at in the end.

    Everything is called by IRI or `prefix:name`; NoSuchName for a prefix, ValueError for a term that there is not.
    """

    def __init__(self, begun: WorldState) -> None:
        self._begun = begun
        self._state = begun
        self.changes: list[Change] = []

    @property
    def state(self) -> WorldState:
        """The version that the changes so far lead to, unchecked."""
        return self._state

    def create(self, individual: str, *classes: str) -> str:
        """Let there be an individual of these classes, return its IRI; one that there is becomes of them too."""
        iri = self._iri(individual)
        self.add(AddIndividual(iri, tuple(map(self._iri, classes))))
        return iri

    def instantiate(self, templates: Templates, template: str, individual: str) -> str:
        """Let there be an individual of which is true what a template says, return its IRI.

        NoSuchName when there is no such template; ValueError when there is such an individual already.
        """
        iri = self._iri(individual)
        self.add(*templates.instance(template, iri, self._state))
        return iri

    def relate(self, subject: str, relation: str, object_: str) -> None:
        """Let a relation hold; a functional one leaves its former value, an inverse functional one its holder."""
        self.add(AddRelation(self._iri(subject), self._iri(relation), self._iri(object_)))

    def unrelate(self, subject: str, relation: str, object_: str) -> None:
        """Let a relation not hold, by no sub-relation or inverse either."""
        self.add(RemoveRelation(self._iri(subject), self._iri(relation), self._iri(object_)))

    def set(self, individual: str, property_: str, value: Value) -> None:
        """Give a property this value and no other; numbers in SI units."""
        self.add(SetProperty(self._iri(individual), self._iri(property_), value))

    def clear(self, individual: str, property_: str) -> None:
        """Leave a property without a value."""
        self.add(ClearProperty(self._iri(individual), self._iri(property_)))

    def remove(self, individual: str) -> None:
        """Let an individual be gone, with all facts about it."""
        self.add(RemoveIndividual(self._iri(individual)))

    def add(self, *changes: Change) -> None:
        """Make changes after those so far."""
        short = self._begun.vocabulary.short
        strange = [iri for change in changes if (iri := unknown_term(self._begun, change)) is not None]
        if strange:
            raise ValueError(f"there is no relation or property {short(strange[0])}")
        self._state = self._state.with_changes(changes)
        self.changes += changes

    def _iri(self, name: str) -> str:
        return expand_name(name, self._begun.vocabulary)
