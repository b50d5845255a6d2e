"""The next version of the world while changes are made to it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, assert_never

from skillc_runtime.world.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
)
from skillc_runtime.world.closure import Closure
from skillc_runtime.world.links import NONE
from skillc_runtime.world.members import Members
from skillc_runtime.world.values import Value

if TYPE_CHECKING:
    from skillc_runtime.world.state import WorldState


class Draft:
    """A version in the making: copies only what is written."""

    def __init__(self, state: WorldState) -> None:
        self._state = state
        self._closure = Closure(state.axioms, state.asserted, state.facts)
        self._direct: dict[str, frozenset[str]] = {}
        self._classes: dict[str, frozenset[str]] = {}
        self._members: dict[str, dict[str, bool]] = {}
        self._values: dict[str, dict[str, Value | None]] = {}

    def make(self, change: Change) -> None:
        """Make one change, unchecked."""
        match change:
            case AddRelation(subject, relation, object_):
                self._add_relation(subject, relation, object_)
            case RemoveRelation(subject, relation, object_):
                self._closure.remove(subject, relation, object_)
            case SetProperty(individual, property_, value):
                self._values.setdefault(property_, {})[individual] = value
            case ClearProperty(individual, property_):
                self._values.setdefault(property_, {})[individual] = None
            case AddIndividual(individual, types):
                self._classify(individual, self._types(individual) | set(types))
            case RemoveIndividual(individual):
                self._remove_individual(individual)
            case _:
                assert_never(change)

    def frozen(self) -> WorldState:
        """Return the finished version."""
        state = self._state
        asserted, facts = self._closure.frozen()
        stored = state.stored
        if self._values:
            stored = {**stored, **{iri: stored[iri].updated(values) for iri, values in self._values.items()}}
        state = replace(state, asserted=asserted, facts=facts, stored=stored)
        if not self._direct:
            return state
        return replace(
            state,
            direct=state.direct.updated(self._direct),
            classes=state.classes.updated(self._classes),
            members={**state.members, **{cls: self._members_of(cls) for cls in self._members}},
        )

    def _add_relation(self, subject: str, relation: str, object_: str) -> None:
        relations = self._state.vocabulary.relations
        for implied, flipped in self._state.axioms.implied[relation]:
            holder, held = (object_, subject) if flipped else (subject, object_)
            if relations[implied].functional:
                for former in self._closure.edges_from(holder, implied) - {held}:
                    self._closure.remove(holder, implied, former)
            if relations[implied].inverse_functional:
                for former in self._closure.edges_to(implied, held) - {holder}:
                    self._closure.remove(former, implied, held)
        self._closure.add(subject, relation, object_)

    def _types(self, individual: str) -> frozenset[str]:
        return self._direct[individual] if individual in self._direct else self._state.types(individual)

    def _classify(self, individual: str, types: frozenset[str]) -> None:
        if individual in self._classes:
            former = self._classes[individual]
        else:
            former = self._state.classes.get(individual)
        present = self._state.axioms.superclasses(types) if types else NONE
        for cls in former - present:
            self._members.setdefault(cls, {})[individual] = False
        for cls in present - former:
            self._members.setdefault(cls, {})[individual] = True
        self._direct[individual] = types or NONE
        self._classes[individual] = present

    def _members_of(self, cls: str) -> Members:
        return self._state.members.get(cls, Members()).updated(self._members[cls])

    def _remove_individual(self, individual: str) -> None:
        for relation in self._state.vocabulary.relations:
            for object_ in self._closure.edges_from(individual, relation):
                self._closure.remove(individual, relation, object_)
            for subject in self._closure.edges_to(relation, individual):
                self._closure.remove(subject, relation, individual)
        for property_, table in self._state.stored.items():
            written = self._values.get(property_, {})
            if individual in written or table.get(individual) is not None:
                self._values.setdefault(property_, {})[individual] = None
        self._classify(individual, NONE)
