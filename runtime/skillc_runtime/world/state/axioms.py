"""What follows from a fact by the axioms of its relation, worked out once per vocabulary."""

from __future__ import annotations

from typing import TypeAlias

from skillc_compiler.library.vocabulary import THING, RelationTerm, Vocabulary
from skillc_runtime.world.state.computed import Computed

Directed: TypeAlias = tuple[str, bool]
"""A relation, and whether it is read from object to subject."""


class Axioms:
    """For each relation, what it implies and what implies it, by sub-relations, inverses and symmetry.

    `implied[r]` holds (x, flipped) when r(s, o) makes x(s, o), or x(o, s) if flipped; `sources` is its converse.
    `transitive` also has the relations equivalent to a transitive one. `carriers[x]` are the transitive relations
    whose every consequence also holds in x, which is not transitive itself. `plain` relations have only the facts
    asserted of them. `computed` relations have none: they hold where their reasoners say so.
    """

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._vocabulary = vocabulary
        self.computed = {
            iri: Computed(term, term.computed_by)
            for iri, term in vocabulary.relations.items()
            if term.computed_by is not None
        }
        self._superclasses: dict[frozenset[str], frozenset[str]] = {}
        steps = _steps(vocabulary.relations)
        self.implied = {iri: _reach(iri, steps) for iri in vocabulary.relations}
        self.sources: dict[str, tuple[Directed, ...]] = {
            iri: tuple(
                (source, flipped) for source, reached in self.implied.items() for x, flipped in reached if x == iri
            )
            for iri in vocabulary.relations
        }
        declared = [iri for iri, term in vocabulary.relations.items() if term.transitive]
        self.transitive = frozenset(x for iri in declared for x, _ in self.implied[iri] if self._implies(x, iri))
        self.carriers = {
            iri: tuple(
                source for source in self.sources[iri] if source[0] in self.transitive and iri not in self.transitive
            )
            for iri in vocabulary.relations
        }
        self.plain = frozenset(
            iri for iri, sources in self.sources.items() if sources == ((iri, False),) and iri not in self.transitive
        )

    def superclasses(self, types: frozenset[str]) -> frozenset[str]:
        """Return the classes with all their superclasses and `owl:Thing`; the same object for the same classes."""
        if types not in self._superclasses:
            known = self._vocabulary.ancestors
            self._superclasses[types] = frozenset({THING}).union(*(known.get(cls, {cls}) for cls in types))
        return self._superclasses[types]

    def _implies(self, one: str, other: str) -> bool:
        return any(x == other for x, _ in self.implied[one])


def _steps(relations: dict[str, RelationTerm]) -> dict[str, set[Directed]]:
    steps: dict[str, set[Directed]] = {iri: set() for iri in relations}
    for iri, term in relations.items():
        steps[iri].update((parent, False) for parent in term.parents if parent in relations)
        if term.inverse in relations and term.inverse is not None:
            steps[iri].add((term.inverse, True))
            steps[term.inverse].add((iri, True))
        if term.symmetric:
            steps[iri].add((iri, True))
    return steps


def _reach(start: str, steps: dict[str, set[Directed]]) -> tuple[Directed, ...]:
    seen: set[Directed] = set()
    todo: list[Directed] = [(start, False)]
    while todo:
        relation, flipped = todo.pop()
        if (relation, flipped) not in seen:
            seen.add((relation, flipped))
            todo.extend((other, flipped != turn) for other, turn in steps[relation])
    return tuple(sorted(seen))
