"""Immutable versions of the facts about the world, indexed so that a lookup costs a few dictionary probes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import assert_never

from skillc_rdf.vocabulary.types import THING, Vocabulary
from skillc_runtime.world.state.axioms import WorldAxioms
from skillc_runtime.world.state.changes import (
    AddIndividual,
    AddRelation,
    Change,
    ClearProperty,
    RemoveIndividual,
    RemoveRelation,
    SetProperty,
)
from skillc_runtime.world.state.closure import ClosureBuilder
from skillc_runtime.world.state.consistency.hidden_truth import NOTHING_HIDDEN, HiddenTruth
from skillc_runtime.world.state.values import Value, has_value
from skillc_runtime.world.state.versioned import EMPTY, PairIndex, VersionedMap, VersionedSet


@dataclass(frozen=True, slots=True, eq=False, weakref_slot=True)
class WorldState:
    """Individuals with their classes, relations and properties; closed world, unique names.

    `asserted` holds the relations as they were written; `facts` also holds those that follow by sub-relations,
    inverses, symmetry and transitivity. Computed relations have no entries: `holds`, `objects` and so on call their
    reasoners. `direct` holds the classes as they were written, `classes` also their superclasses. What is `hidden` is
    true but not known: nothing but simulated looks reads it. Versions share unchanged parts.
    """

    vocabulary: Vocabulary
    axioms: WorldAxioms
    direct: VersionedMap[str, frozenset[str]]
    classes: VersionedMap[str, frozenset[str]]
    members: dict[str, VersionedSet]
    asserted: dict[str, PairIndex]
    facts: dict[str, PairIndex]
    stored: dict[str, VersionedMap[str, Value | None]]
    hidden: HiddenTruth = NOTHING_HIDDEN

    @staticmethod
    def empty(vocabulary: Vocabulary) -> WorldState:
        """Return a world without individuals."""
        links = {iri: PairIndex.empty() for iri in vocabulary.relations}
        stored: dict[str, VersionedMap[str, Value | None]] = {iri: VersionedMap(None) for iri in vocabulary.properties}
        return WorldState(
            vocabulary,
            WorldAxioms(vocabulary),
            VersionedMap(EMPTY),
            VersionedMap(EMPTY),
            {},
            links,
            dict(links),
            stored,
        )

    @property
    def individuals(self) -> frozenset[str]:
        """All individuals."""
        return self.instances(THING)

    def exists(self, individual: str) -> bool:
        """Whether there is such an individual."""
        return bool(self.direct.get(individual))

    def types(self, individual: str) -> frozenset[str]:
        """Return the declared classes of an individual, without their superclasses."""
        return self.direct.get(individual)

    def is_a(self, individual: str, cls: str) -> bool:
        """Whether the individual is of the class or of a subclass."""
        return cls in self.classes.get(individual)

    def instances(self, cls: str) -> frozenset[str]:
        """Return all individuals of a class and its subclasses."""
        return self.members[cls].members() if cls in self.members else EMPTY

    def holds(self, subject: str, relation: str, object_: str) -> bool:
        """Whether the relation holds; KeyError for one the vocabulary lacks."""
        computed = self.axioms.computed
        if relation in computed:
            return computed[relation].holds(self, subject, object_)
        return object_ in self.facts[relation].forward.get(subject)

    def objects(self, subject: str, relation: str) -> frozenset[str]:
        """Return the individuals that the subject has the relation to."""
        computed = self.axioms.computed
        if relation in computed:
            return computed[relation].objects(self, subject)
        return self.facts[relation].forward.get(subject)

    def subjects(self, relation: str, object_: str) -> frozenset[str]:
        """Return the individuals that have the relation to the object."""
        computed = self.axioms.computed
        if relation in computed:
            return computed[relation].subjects(self, object_)
        return self.facts[relation].backward.get(object_)

    def pairs(self, relation: str, subject: str | None = None, object_: str | None = None) -> Iterable[tuple[str, str]]:
        """Return the pairs for which the relation holds, with a subject and object if given, in no particular order."""
        if subject is not None and object_ is not None:
            return [(subject, object_)] if self.holds(subject, relation, object_) else []
        if subject is not None:
            return [(subject, each) for each in self.objects(subject, relation)]
        if object_ is not None:
            return [(each, object_) for each in self.subjects(relation, object_)]
        computed = self.axioms.computed
        if relation in computed:
            return computed[relation].pairs(self)
        return self.facts[relation].pairs()

    def value(self, individual: str, property_: str) -> Value | None:
        """Return the stored value, None when missing; a tuple of all values if the property is not functional."""
        return self.stored[property_].get(individual)

    def individuals_with(self, property_: str, value: Value) -> tuple[str, ...]:
        """Return the individuals whose stored property has the value, sorted by IRI."""
        return tuple(
            sorted(individual for individual, found in self.stored[property_].items() if has_value(found, value))
        )

    def with_changes(self, changes: Iterable[Change]) -> WorldState:
        """Return the next version after the changes, in order and unchecked; WorldModel.commit checks them.

        A functional relation loses its former object, an inverse functional one its former subject.
        """
        builder, applied = WorldStateBuilder(self), tuple(changes)
        for change in applied:
            builder.apply(change)
        after = builder.build()
        return (
            replace(after, hidden=self.hidden.without_known(applied, self.vocabulary)) if self.hidden.facts else after
        )

    def reveal(self) -> WorldState:
        """Return the world as it is, with what is not known."""
        return self.with_changes(self.hidden.facts)


class WorldStateBuilder:
    """Builds the next version of a world; copies only what is written."""

    def __init__(self, state: WorldState) -> None:
        self._state = state
        self._closure = ClosureBuilder(state.axioms, state.asserted, state.facts)
        self._direct: dict[str, frozenset[str]] = {}
        self._classes: dict[str, frozenset[str]] = {}
        self._members: dict[str, dict[str, bool]] = {}
        self._values: dict[str, dict[str, Value | None]] = {}

    def apply(self, change: Change) -> None:
        """Apply one change, unchecked."""
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

    def build(self) -> WorldState:
        """Return the next version."""
        state = self._state
        asserted, facts = self._closure.build()
        stored = state.stored
        if self._values:
            stored = {**stored, **{iri: stored[iri].with_changes(values) for iri, values in self._values.items()}}
        state = replace(state, asserted=asserted, facts=facts, stored=stored)
        if not self._direct:
            return state
        return replace(
            state,
            direct=state.direct.with_changes(self._direct),
            classes=state.classes.with_changes(self._classes),
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
        present = self._state.axioms.superclasses(types) if types else EMPTY
        for cls in former - present:
            self._members.setdefault(cls, {})[individual] = False
        for cls in present - former:
            self._members.setdefault(cls, {})[individual] = True
        self._direct[individual] = types or EMPTY
        self._classes[individual] = present

    def _members_of(self, cls: str) -> VersionedSet:
        return self._state.members.get(cls, VersionedSet()).with_changes(self._members[cls])

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
        self._classify(individual, EMPTY)
