"""Incremental closure of asserted relations: updates their consequences with each assertion."""

from __future__ import annotations

from collections.abc import Callable, Set

from skillc_rdf.vocabulary.closure import reachable
from skillc_runtime.world.state.axioms import WorldAxioms
from skillc_runtime.world.state.versioned import PairIndex, PairIndexBuilder


class ClosureBuilder:
    """Asserted relations and their consequences while the next version is built.

    An *edge* of a relation is a pair that follows from one assertion alone (sub-relation, inverse, symmetry). The facts
    of a transitive relation are the transitive closure of its edges; the facts of any other relation are its edges
    and the facts of its transitive sub-relations.
    """

    def __init__(self, axioms: WorldAxioms, asserted: dict[str, PairIndex], facts: dict[str, PairIndex]) -> None:
        self._axioms = axioms
        self._asserted, self._facts = asserted, facts
        self._asserting: dict[str, PairIndexBuilder] = {}
        self._following: dict[str, PairIndexBuilder] = {}

    def edges_from(self, subject: str, relation: str) -> set[str]:
        """Return the objects of the relation's edges from a subject."""
        found: set[str] = set()
        for source, flipped in self._axioms.sources[relation]:
            written = self._assertions(source)
            found |= written.subjects(subject) if flipped else written.objects(subject)
        return found

    def edges_to(self, relation: str, object_: str) -> set[str]:
        """Return the subjects of the relation's edges to an object."""
        found: set[str] = set()
        for source, flipped in self._axioms.sources[relation]:
            written = self._assertions(source)
            found |= written.objects(object_) if flipped else written.subjects(object_)
        return found

    def add(self, subject: str, relation: str, object_: str) -> None:
        """Assert a relation."""
        self._assertions(relation).add(subject, object_)
        for implied, flipped in self._axioms.implied[relation]:
            start, end = (object_, subject) if flipped else (subject, object_)
            if implied in self._axioms.transitive:
                self._connect(implied, start, end)
            elif implied not in self._axioms.plain:
                self._consequences(implied).add(start, end)

    def remove(self, subject: str, relation: str, object_: str) -> None:
        """Retract every assertion that makes the relation an edge between the two."""
        for source, flipped in self._axioms.sources[relation]:
            start, end = (object_, subject) if flipped else (subject, object_)
            if end in self._assertions(source).objects(start):
                self._retract(start, source, end)

    def build(self) -> tuple[dict[str, PairIndex], dict[str, PairIndex]]:
        """Return the asserted relations and the facts of the finished version."""
        if not self._asserting:
            return self._asserted, self._facts
        asserted = {**self._asserted, **{iri: builder.build() for iri, builder in self._asserting.items()}}
        facts = {**self._facts, **{iri: builder.build() for iri, builder in self._following.items()}}
        facts.update((iri, asserted[iri]) for iri in self._asserting if iri in self._axioms.plain)
        return asserted, facts

    def _assertions(self, relation: str) -> PairIndexBuilder:
        if relation not in self._asserting:
            self._asserting[relation] = PairIndexBuilder(self._asserted[relation])
        return self._asserting[relation]

    def _consequences(self, relation: str) -> PairIndexBuilder:
        if relation not in self._following:
            self._following[relation] = PairIndexBuilder(self._facts[relation])
        return self._following[relation]

    def _retract(self, subject: str, relation: str, object_: str) -> None:
        self._assertions(relation).discard(subject, object_)
        for implied, flipped in self._axioms.implied[relation]:
            start, end = (object_, subject) if flipped else (subject, object_)
            if implied in self._axioms.transitive:
                self._disconnect(implied, start, end)
            elif implied not in self._axioms.plain:
                self._recheck(implied, start, end)

    def _connect(self, relation: str, start: str, end: str) -> None:
        """Add an edge to a transitive relation: what reaches its start now reaches what its end reaches."""
        facts = self._consequences(relation)
        if end in facts.objects(start):
            return
        before, after = {start, *facts.subjects(start)}, {end, *facts.objects(end)}
        for first in before:
            for last in after - facts.objects(first):
                facts.add(first, last)
                self._carry(relation, first, last)

    def _disconnect(self, relation: str, start: str, end: str) -> None:
        """Remove an edge from a transitive relation, and the pairs that no other path connects."""
        facts = self._consequences(relation)
        if end in self.edges_from(start, relation):
            return
        before, after = {start, *facts.subjects(start)}, {end, *facts.objects(end)}
        if len(before) < len(after):
            left = {first: _reachable_from(first, lambda node: self.edges_from(node, relation)) for first in before}
            lost = [(first, last) for first in before for last in after - left[first]]
        else:
            left = {last: _reachable_from(last, lambda node: self.edges_to(relation, node)) for last in after}
            lost = [(first, last) for last in after for first in before - left[last]]
        for first, last in lost:
            facts.discard(first, last)
        for first, last in lost:
            for implied, flipped in self._axioms.implied[relation]:
                if implied not in self._axioms.transitive:
                    self._recheck(implied, *((last, first) if flipped else (first, last)))

    def _carry(self, relation: str, first: str, last: str) -> None:
        for implied, flipped in self._axioms.implied[relation]:
            if implied not in self._axioms.transitive:
                self._consequences(implied).add(*((last, first) if flipped else (first, last)))

    def _recheck(self, relation: str, start: str, end: str) -> None:
        """Remove a pair of a relation that is not transitive unless something still implies it."""
        if end in self.edges_from(start, relation):
            return
        for carrier, flipped in self._axioms.carriers[relation]:
            facts = self._consequences(carrier)
            if end in (facts.subjects(start) if flipped else facts.objects(start)):
                return
        self._consequences(relation).discard(start, end)


def _reachable_from(start: str, step: Callable[[str], Set[str]]) -> set[str]:
    """Return what is reachable in one or more steps; the start itself only if it is on a cycle."""
    return reachable(step(start), step)
