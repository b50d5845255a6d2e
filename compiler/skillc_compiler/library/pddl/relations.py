"""What follows from what among relations: sub-relations, inverses and symmetry, as predicates to read and to delete."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

from skillc_compiler.library.vocabulary import RelationTerm, Vocabulary


@dataclass(frozen=True, order=True)
class Reading:
    """The relation, read as (object, subject) when swapped."""

    relation: str
    swapped: bool

    def turned(self, swap: bool) -> Reading:
        """Return the reading of the same relation with the sides exchanged if `swap`."""
        return Reading(self.relation, self.swapped != swap)


@dataclass
class Relations:
    """The axioms of a vocabulary's relations; an answer is computed once."""

    vocabulary: Vocabulary
    _below: dict[str, tuple[Reading, ...]] = field(default_factory=dict)
    _canonical: dict[str, Reading] = field(default_factory=dict)

    def canonical(self, relation: str) -> Reading:
        """Return the one relation that stands for all that say the same, inverses included: the first by IRI."""
        if relation not in self._canonical:
            below, above = self._closure(relation, self._narrower), self._closure(relation, self._wider)
            self._canonical[relation] = min(set(below).intersection(above), default=Reading(relation, False))
        return self._canonical[relation]

    def below(self, relation: str) -> tuple[Reading, ...]:
        """Return all canonical relations of which a fact makes `relation` hold, its own included."""
        if relation not in self._below:
            reached = self._closure(relation, self._narrower)
            turned = {self.canonical(each.relation).turned(each.swapped) for each in reached}
            self._below[relation] = tuple(sorted(turned))
        return self._below[relation]

    def above(self, relation: str) -> tuple[Reading, ...]:
        """Return all relations that hold when `relation` does, its own included."""
        return self._closure(relation, self._wider)

    def is_computed(self, relation: str) -> bool:
        """Whether a relation follows from other facts by a computation."""
        return relation in self.vocabulary.relations and self._term(relation).computed_by is not None

    def transitive_below(self, relation: str) -> tuple[str, ...]:
        """Return those transitive relations of which a fact makes `relation` hold."""
        reached = {each.relation for each in self._closure(relation, self._narrower)}
        return tuple(sorted(each for each in reached if self._term(each).transitive))

    def _term(self, relation: str) -> RelationTerm:
        return self.vocabulary.relations[relation]

    @cached_property
    def _inverses(self) -> dict[str, tuple[str, ...]]:
        pairs = {(iri, term.inverse) for iri, term in self.vocabulary.relations.items() if term.inverse}
        both = sorted(pairs | {(there, here) for here, there in pairs})
        known = [(here, there) for here, there in both if here in self.vocabulary.relations]
        return {iri: tuple(there for here, there in known if here == iri) for iri, _ in known}

    @cached_property
    def _wider(self) -> dict[str, tuple[str, ...]]:
        return {iri: self._term(iri).parents for iri in self.vocabulary.relations}

    @cached_property
    def _narrower(self) -> dict[str, tuple[str, ...]]:
        return {
            iri: tuple(sorted(sub for sub, term in self.vocabulary.relations.items() if iri in term.parents))
            for iri in self.vocabulary.relations
        }

    def _closure(self, relation: str, steps: dict[str, tuple[str, ...]]) -> tuple[Reading, ...]:
        seen: set[Reading] = set()
        todo = [Reading(relation, False)]
        while todo:
            current = todo.pop()
            if current in seen or current.relation not in self.vocabulary.relations:
                continue
            seen.add(current)
            todo.extend(Reading(each, current.swapped) for each in steps.get(current.relation, ()))
            todo.extend(Reading(each, not current.swapped) for each in self._inverses.get(current.relation, ()))
            if self._term(current.relation).symmetric:
                todo.append(current.turned(True))
        return tuple(sorted(seen))
