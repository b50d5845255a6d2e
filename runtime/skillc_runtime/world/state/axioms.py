"""The axioms of relations in the form in which the world state needs them, computed once per vocabulary."""

from __future__ import annotations

from skillc_rdf.vocabulary.closure import Directed, OnDemand
from skillc_rdf.vocabulary.types import THING, Vocabulary
from skillc_runtime.world.state.computed import ComputedRelation, ReasonedRelation
from skillc_runtime.world.state.python_calls import load_python


class WorldAxioms:
    """The consequences of the vocabulary's relation axioms for stored facts.

    `implied`, `sources` and `transitive` are those of the vocabulary's closure. `carriers[x]`, for a relation x that is
    not transitive, are the transitive relations of which every fact also holds in x. `plain` relations have only
    asserted facts. `computed` relations have no stored facts: reasoners, or conditions, decide whether they hold.
    """

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._vocabulary = vocabulary
        self.computed: dict[str, ComputedRelation] = {
            iri: load_python(term.computed_by)(term, vocabulary.definitions[iri])
            if iri in vocabulary.definitions
            else ReasonedRelation(term, term.computed_by)
            for iri, term in vocabulary.relations.items()
            if term.computed_by is not None
        }
        self._superclasses: dict[frozenset[str], frozenset[str]] = {}
        closure = vocabulary.closure
        self.implied, self.sources, self.transitive = closure.implied, closure.sources, closure.transitive
        self.carriers = OnDemand(vocabulary.relations, self._carriers)
        self.plain = frozenset(
            iri for iri in vocabulary.relations if not closure.is_implied(iri) and iri not in self.transitive
        )

    def superclasses(self, types: frozenset[str]) -> frozenset[str]:
        """Return the classes with all their superclasses and `owl:Thing`; the same object for the same classes."""
        if types not in self._superclasses:
            known = self._vocabulary.ancestors
            self._superclasses[types] = frozenset({THING}).union(*(known.get(cls, {cls}) for cls in types))
        return self._superclasses[types]

    def _carriers(self, iri: str) -> tuple[Directed, ...]:
        if iri in self.transitive:
            return ()
        return tuple(source for source in self.sources[iri] if source.relation in self.transitive)
