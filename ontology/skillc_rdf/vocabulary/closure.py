"""The closure of relations: what follows from each by sub-relations, inverses and symmetry."""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import NamedTuple, Protocol, TypeVar

from skillc_rdf.vocabulary.components import components

T = TypeVar("T")
Node = TypeVar("Node", bound=Hashable)
Value = TypeVar("Value", bound=Hashable)


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


class OnDemand(Mapping[str, T]):
    """A mapping whose values are computed when they are asked for, once each."""

    def __init__(self, keys: Collection[str], compute: Callable[[str], T]) -> None:
        self._keys, self._compute = keys, compute
        self._known: dict[str, T] = {}

    def __getitem__(self, key: str) -> T:
        if key not in self._known:
            if key not in self._keys:
                raise KeyError(key)
            self._known[key] = self._compute(key)
        return self._known[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._keys)

    def __len__(self) -> int:
        return len(self._keys)


class RelationClosure:
    """What each relation implies and what implies it; references to unknown relations are ignored.

    `implied[r]` contains (x, flipped) if r(s, o) implies x(s, o), or x(o, s) if flipped; r is included; sorted.
    `sources` is the converse. Both grow with the square of the depth of a hierarchy: they are computed on demand, and
    equivalent relations share theirs. `transitive` are the transitive relations and those equivalent to one.
    """

    def __init__(self, relations: Mapping[str, RelationAxioms]) -> None:
        self._after = _steps(relations)
        self._before = _reversed(self._after)
        self._groups = _groups(self._after)
        self._canonical = _canonical(self._groups)
        self._found: dict[tuple[Directed, bool], tuple[Directed, ...]] = {}
        self.implied = OnDemand(relations, self._implied_by)
        self.sources = OnDemand(relations, self._sources_of)
        self.canonical_implied = OnDemand(relations, self._canonical_implied_by)
        """The canonical relations that each relation implies, sorted."""
        self.canonical_sources = OnDemand(relations, self._canonical_sources_of)
        """The canonical relations that imply each relation, its own included, sorted."""
        stated = {self.canonical(iri).relation for iri, term in relations.items() if term.transitive}
        self.transitive = frozenset(iri for iri in relations if self.canonical(iri).relation in stated)

    def canonical(self, relation: str) -> Directed:
        """Return the representative of all relations equivalent to this one, inverses included: the first by IRI."""
        return self._canonical.get(relation, Directed(relation))

    def is_implied(self, relation: str) -> bool:
        """Whether facts of a relation follow from others: of another relation, or of its own read backwards."""
        return bool(self._before[relation])

    def above(self, relations: Iterable[str]) -> frozenset[str]:
        """Return the relations that at least one of the given ones implies, these included."""
        return frozenset(reachable(relations, lambda iri: (each.relation for each in self._after[iri])))

    def below(self, relations: Iterable[str]) -> frozenset[str]:
        """Return the relations that imply at least one of the given ones, these included."""
        return frozenset(reachable(relations, lambda iri: (each.relation for each in self._before[iri])))

    @cached_property
    def equivalents(self) -> tuple[tuple[str, ...], ...]:
        """The relations in groups of equivalents, inverses included: sorted, each group after those that it implies."""
        return tuple(dict.fromkeys(tuple(sorted({each.relation for each in group})) for group in self._groups))

    def inherited(self, own: Mapping[Directed, frozenset[Value]]) -> dict[Directed, frozenset[Value]]:
        """Return for each relation, in both directions, what `own` has for those that it implies.

        Relations to which nothing is added share what they inherit: a long chain takes no more space than what is new.
        """
        found: dict[Directed, frozenset[Value]] = {}
        for group in self._groups:
            after = (step for each in group for step in _following(each, self._after))
            parts = {own.get(each, frozenset()) for each in group} | {found[step] for step in after if step in found}
            most = max(parts, key=len)
            found |= dict.fromkeys(group, most if all(part <= most for part in parts) else most.union(*parts))
        return found

    def directly_above(self, relations: Collection[str]) -> frozenset[str]:
        """Return the other relations that follow from one of the given ones by a single axiom."""
        return frozenset(each.relation for iri in relations for each in self._after[iri]).difference(relations)

    def twisted(self, relations: Collection[str]) -> frozenset[str]:
        """Return those of the relations that may imply one in both directions, by axioms among the given ones.

        They are connected, by axioms read either way, with themselves read backwards.
        """
        found: set[str] = set()
        seen: set[str] = set()
        for iri in relations:
            if iri not in seen:
                connected = reachable([Directed(iri)], lambda each: self._beside(each, relations))
                names = {each.relation for each in connected}
                seen |= names
                found |= names if len(names) < len(connected) else set()
        return frozenset(found)

    def _beside(self, each: Directed, relations: Collection[str]) -> Iterator[Directed]:
        for steps in (self._after, self._before):
            yield from (step for step in _following(each, steps) if step.relation in relations)

    @cached_property
    def chained(self) -> frozenset[str]:
        """The relations whose facts may follow from chains of any length: transitive ones and what they imply."""
        return self.above(self.transitive)

    # Methods, not lambdas: a closure is sent to other processes.
    def _implied_by(self, iri: str) -> tuple[Directed, ...]:
        return self._reached(self.canonical(iri), True)

    def _sources_of(self, iri: str) -> tuple[Directed, ...]:
        return self._reached(self.canonical(iri), False)

    def _canonical_implied_by(self, iri: str) -> tuple[Directed, ...]:
        return self._in_canonical(self.implied[iri])

    def _canonical_sources_of(self, iri: str) -> tuple[Directed, ...]:
        return self._in_canonical(self.sources[iri])

    def _reached(self, start: Directed, forwards: bool) -> tuple[Directed, ...]:
        key, steps = (start, forwards), self._after if forwards else self._before
        if key not in self._found:
            self._found[key] = tuple(sorted(reachable([start], lambda each: _following(each, steps))))
        return self._found[key]

    def _in_canonical(self, found: Iterable[Directed]) -> tuple[Directed, ...]:
        return tuple(sorted({self.canonical(each.relation).flip(each.flipped) for each in found}))


def reachable(start: Iterable[Node], following: Callable[[Node], Iterable[Node]]) -> set[Node]:
    """Return all nodes of a graph that can be reached from `start`, which is included."""
    reached = set(start)
    todo = list(reached)
    while todo:
        found = frozenset(following(todo.pop())) - reached
        reached |= found
        todo.extend(found)
    return reached


def _following(each: Directed, steps: Mapping[str, Iterable[Directed]]) -> Iterator[Directed]:
    return (step.flip(each.flipped) for step in steps[each.relation])


def _groups(steps: Mapping[str, Iterable[Directed]]) -> tuple[Sequence[Directed], ...]:
    """Return the relations, in both directions, in groups of equivalents, each after those that it implies."""
    nodes = [Directed(iri, flipped) for iri in steps for flipped in (False, True)]
    return tuple(components({each: sorted(_following(each, steps)) for each in nodes}))


def _canonical(groups: Iterable[Sequence[Directed]]) -> dict[str, Directed]:
    first = ((min(group), group) for group in groups)
    return {each.relation: least for least, group in first for each in group if not each.flipped}


def _reversed(steps: Mapping[str, Iterable[Directed]]) -> dict[str, set[Directed]]:
    before: dict[str, set[Directed]] = {iri: set() for iri in steps}
    for iri, found in steps.items():
        for each in found:
            before[each.relation].add(Directed(iri, each.flipped))
    return before


def _steps(relations: Mapping[str, RelationAxioms]) -> dict[str, set[Directed]]:
    steps: dict[str, set[Directed]] = {iri: set() for iri in relations}
    for iri, term in relations.items():
        steps[iri].update(Directed(parent) for parent in term.parents if parent in relations and parent != iri)
        if term.inverse is not None and term.inverse in relations:
            steps[iri].add(Directed(term.inverse, True))
            steps[term.inverse].add(Directed(iri, True))
        if term.symmetric:
            steps[iri].add(Directed(iri, True))
    return steps
