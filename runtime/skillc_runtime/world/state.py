"""One immutable version of what is known of the world, indexed so that a check is a few dictionary probes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from skillc_compiler.library.vocabulary import THING, Vocabulary
from skillc_runtime.world.axioms import Axioms
from skillc_runtime.world.changes import Change
from skillc_runtime.world.draft import Draft
from skillc_runtime.world.links import NONE, Links
from skillc_runtime.world.members import Members
from skillc_runtime.world.table import Table
from skillc_runtime.world.values import Value, has


@dataclass(frozen=True, slots=True, eq=False, weakref_slot=True)
class WorldState:
    """Individuals with their classes, relations and properties; closed world, unique names.

    `asserted` holds the relations as they were written, `facts` also what follows from them: sub-relations, inverses,
    symmetry, transitivity. Computed relations have no entries: `holds` and its like ask what computes them.
    `direct` holds the classes as they were written, `classes` their superclasses too. Versions share all that did not
    change.
    """

    vocabulary: Vocabulary
    axioms: Axioms
    direct: Table[str, frozenset[str]]
    classes: Table[str, frozenset[str]]
    members: dict[str, Members]
    asserted: dict[str, Links]
    facts: dict[str, Links]
    stored: dict[str, Table[str, Value | None]]

    @staticmethod
    def empty(vocabulary: Vocabulary) -> WorldState:
        """Return a world without individuals."""
        links = {iri: Links.empty() for iri in vocabulary.relations}
        stored: dict[str, Table[str, Value | None]] = {iri: Table(None) for iri in vocabulary.properties}
        return WorldState(vocabulary, Axioms(vocabulary), Table(NONE), Table(NONE), {}, links, dict(links), stored)

    @property
    def individuals(self) -> frozenset[str]:
        """All individuals."""
        return self.instances(THING)

    def exists(self, individual: str) -> bool:
        """Whether there is such an individual."""
        return bool(self.direct.get(individual))

    def types(self, individual: str) -> frozenset[str]:
        """Return the classes an individual was declared to be of, without their superclasses."""
        return self.direct.get(individual)

    def is_a(self, individual: str, cls: str) -> bool:
        """Whether the individual is of the class or of a subclass."""
        return cls in self.classes.get(individual)

    def instances(self, cls: str) -> frozenset[str]:
        """Return all individuals of a class and its subclasses."""
        return self.members[cls].all() if cls in self.members else NONE

    def holds(self, subject: str, relation: str, object_: str) -> bool:
        """Whether the relation holds; KeyError for one the vocabulary lacks."""
        computed = self.axioms.computed
        if relation in computed:
            return computed[relation].holds(self, subject, object_)
        return object_ in self.facts[relation].forward.get(subject)

    def objects(self, subject: str, relation: str) -> frozenset[str]:
        """Return all that the subject has the relation to."""
        computed = self.axioms.computed
        if relation in computed:
            return computed[relation].objects(self, subject)
        return self.facts[relation].forward.get(subject)

    def subjects(self, relation: str, object_: str) -> frozenset[str]:
        """Return all that have the relation to the object."""
        computed = self.axioms.computed
        if relation in computed:
            return computed[relation].subjects(self, object_)
        return self.facts[relation].backward.get(object_)

    def pairs(self, relation: str) -> Iterator[tuple[str, str]]:
        """Yield every pair of which the relation holds, in no particular order."""
        computed = self.axioms.computed
        if relation in computed:
            return computed[relation].pairs(self)
        return self.facts[relation].pairs()

    def value(self, individual: str, property_: str) -> Value | None:
        """Return the stored value, None when missing; a tuple of all values for a property that is not functional."""
        return self.stored[property_].get(individual)

    def having(self, property_: str, value: Value) -> tuple[str, ...]:
        """Return the individuals whose stored property has the value, sorted by IRI."""
        return tuple(sorted(individual for individual, found in self.stored[property_].items() if has(found, value)))

    def changed(self, changes: Iterable[Change]) -> WorldState:
        """Return the next version with the changes made in order, unchecked (WorldModel.commit checks them).

        A functional relation loses the former value, an inverse functional one the former holder.
        """
        draft = Draft(self)
        for change in changes:
            draft.make(change)
        return draft.frozen()
