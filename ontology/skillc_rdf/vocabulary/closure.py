"""The closure of relations: what follows from each by sub-relations, inverses and symmetry."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, Protocol, TypeVar

T = TypeVar("T")
Node = TypeVar("Node", bound=Hashable)


class Directed(NamedTuple):
    """A relation; if `flipped`, with subject and object exchanged."""

    relation: str
    flipped: bool = False

    def flip(self, flipped: bool) -> Directed:
        """Return the relation in the opposite direction if `flipped`, else itself."""
        return Directed(self.relation, self.flipped != flipped)

    def ends(self, subject: T, object_: T) -> tuple[T, T]:
        """Return the two terms as subject and object of the relation itself."""
        return (object_, subject) if self.flipped else (subject, object_)


class RelationAxioms(Protocol):
    """The axioms of a relation from which others follow."""

    @property
    def parents(self) -> tuple[str, ...]: ...
    @property
    def inverse(self) -> str | None: ...
    @property
    def symmetric(self) -> bool: ...
    @property
    def transitive(self) -> bool: ...


@dataclass(frozen=True)
class RelationClosure:
    """What each relation implies and what implies it.

    `implied[r]` contains (x, flipped) if r(s, o) implies x(s, o), or x(o, s) if flipped; r is included; sorted.
    `sources` is the converse. `transitive` are the transitive relations and those equivalent to one.
    """

    implied: Mapping[str, tuple[Directed, ...]]
    sources: Mapping[str, tuple[Directed, ...]]
    transitive: frozenset[str]

    def canonical(self, relation: str) -> Directed:
        """Return the representative of all relations equivalent to this one, inverses included: the first by IRI."""
        return self._canonical.get(relation, Directed(relation))

    @cached_property
    def canonical_implied(self) -> Mapping[str, tuple[Directed, ...]]:
        """The canonical relations that each relation implies, sorted."""
        return {iri: self._in_canonical(found) for iri, found in self.implied.items()}

    @cached_property
    def canonical_sources(self) -> Mapping[str, tuple[Directed, ...]]:
        """The canonical relations that imply each relation, its own included, sorted."""
        return {iri: self._in_canonical(found) for iri, found in self.sources.items()}

    @cached_property
    def chained(self) -> frozenset[str]:
        """The relations whose facts may follow from chains of any length: transitive ones and what they imply."""
        return frozenset(each.relation for iri in self.transitive for each in self.implied[iri])

    @cached_property
    def _canonical(self) -> Mapping[str, Directed]:
        return {iri: min(set(found).intersection(self.sources[iri])) for iri, found in self.implied.items()}

    def _in_canonical(self, found: Iterable[Directed]) -> tuple[Directed, ...]:
        return tuple(sorted({self.canonical(each.relation).flip(each.flipped) for each in found}))


def relation_closure(relations: Mapping[str, RelationAxioms]) -> RelationClosure:
    """Return the closure of relations by IRI; references to relations that are not among them are ignored."""
    steps = _steps(relations)

    def following(each: Directed) -> Iterable[Directed]:
        return (step.flip(each.flipped) for step in steps[each.relation])

    implied = {iri: tuple(sorted(reachable([Directed(iri)], following))) for iri in relations}
    sources: dict[str, list[Directed]] = {iri: [] for iri in relations}
    for iri, found in implied.items():
        for each in found:
            sources[each.relation].append(Directed(iri, each.flipped))
    names = {iri: {each.relation for each in found} for iri, found in implied.items()}
    stated = [iri for iri, term in relations.items() if term.transitive]
    transitive = frozenset(other for iri in stated for other in names[iri] if iri in names[other])
    return RelationClosure(implied, {iri: tuple(found) for iri, found in sources.items()}, transitive)


def reachable(start: Iterable[Node], following: Callable[[Node], Iterable[Node]]) -> set[Node]:
    """Return all nodes of a graph that can be reached from `start`, which is included."""
    reached = set(start)
    todo = list(reached)
    while todo:
        found = frozenset(following(todo.pop())) - reached
        reached |= found
        todo.extend(found)
    return reached


def _steps(relations: Mapping[str, RelationAxioms]) -> dict[str, set[Directed]]:
    steps: dict[str, set[Directed]] = {iri: set() for iri in relations}
    for iri, term in relations.items():
        steps[iri].update(Directed(parent) for parent in term.parents if parent in relations)
        if term.inverse is not None and term.inverse in relations:
            steps[iri].add(Directed(term.inverse, True))
            steps[term.inverse].add(Directed(iri, True))
        if term.symmetric:
            steps[iri].add(Directed(iri, True))
    return steps
