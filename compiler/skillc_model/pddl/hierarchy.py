"""The class hierarchy as a tree of PDDL types; classes with several parents become static unary predicates."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import cached_property

from skillc_model.pddl.domain import ROOT, PlanningType
from skillc_rdf.vocabulary.types import THING, Vocabulary


class Hierarchy:
    """The tree of types: each class below the deepest of its parents.

    `combined` are the sets of classes of individuals that have several; each acts as a class with several parents.
    """

    def __init__(self, vocabulary: Vocabulary, names: Mapping[str, str], combined: Collection[frozenset[str]] = ()):
        self._vocabulary = vocabulary
        self._names = names
        self._combined = sorted(combined, key=sorted)
        self._covers: dict[str, str] = {}

    @cached_property
    def _parents(self) -> dict[str, str]:
        return {iri: _deepest(term.parents, self._vocabulary) for iri, term in self._vocabulary.classes.items()}

    @cached_property
    def types(self) -> tuple[PlanningType, ...]:
        """All classes as types, by name."""
        types = [
            PlanningType(self._name(iri), self._name(parent), iri, len(self._chain(iri)) - 2)
            for iri, parent in self._parents.items()
        ]
        return tuple(sorted(types, key=lambda each: each.name))

    def type_name(self, cls: str) -> str:
        """Return the most specific type that contains every individual of the class."""
        return self._name(self._cover(cls))

    def is_exact(self, cls: str) -> bool:
        """Whether the type returned by `type_name` contains only individuals of the class."""
        return self._cover(cls) == cls

    def common(self, classes: Iterable[str]) -> str:
        """Return the deepest common superclass."""
        return find_common_class(classes, self._vocabulary)

    def type_of(self, classes: Iterable[str]) -> str:
        """Return the most specific type for an individual of these classes."""
        known = [cls for cls in classes if cls in self._vocabulary.classes]
        return self._name(min(known, key=self._order)) if known else ROOT

    def overlap(self, one: str, other: str) -> bool:
        """Whether an individual may be of both classes: by a class below both, or because it has several."""
        ancestors = self._vocabulary.ancestors
        kinds = (*({each} for each in self._vocabulary.classes), *self._combined)
        above = (frozenset({THING}).union(*(ancestors.get(each, {each}) for each in kind)) for kind in kinds)
        return any(one in each and other in each for each in above)

    def meet(self, one: str, other: str) -> bool:
        """Whether an object may be of both types."""
        return self.is_below(one, other) or self.is_below(other, one)

    def join(self, one: str, other: str) -> str:
        """Return the narrowest common supertype."""
        while not self.is_below(other, one):
            one = self._type_parents[one]
        return one

    def is_below(self, type_: str, above: str) -> bool:
        """Whether every object of the type is also of the type `above`."""
        while type_ not in (above, ROOT):
            type_ = self._type_parents[type_]
        return type_ == above or above == ROOT

    @cached_property
    def _type_parents(self) -> dict[str, str]:
        return {each.name: each.parent for each in self.types}

    def _order(self, cls: str) -> tuple[int, str]:
        """Sort key of classes: those with most supertypes first."""
        return 2 - len(self._chain(cls)), self._name(cls)

    def _name(self, cls: str) -> str:
        return ROOT if cls == THING else self._names[cls]

    def _chain(self, cls: str) -> list[str]:
        chain = [cls]
        while chain[-1] != THING:
            chain.append(self._parents.get(chain[-1], THING))
        return chain

    def _cover(self, cls: str) -> str:
        if cls not in self._covers:
            chains = [set(self._chain(each)) for each in self._placed_below(cls)]
            self._covers[cls] = next(each for each in self._chain(cls) if all(each in chain for chain in chains))
        return self._covers[cls]

    def _placed_below(self, cls: str) -> list[str]:
        ancestors = self._vocabulary.ancestors
        classes = [each for each in self._vocabulary.classes if cls in ancestors[each]]
        mixed = [
            min(known, key=self._order)
            for known in ([each for each in kinds if each in ancestors] for kinds in self._combined)
            if any(cls in ancestors[each] for each in known)
        ]
        return classes + mixed


def find_common_class(classes: Iterable[str], vocabulary: Vocabulary) -> str:
    """Return the deepest common superclass; `owl:Thing` if there are no classes."""
    above = [vocabulary.ancestors.get(cls, frozenset({THING})) for cls in classes]
    return _deepest(frozenset.intersection(*above) if above else (), vocabulary)


def _deepest(classes: Iterable[str], vocabulary: Vocabulary) -> str:
    known = [cls for cls in classes if cls in vocabulary.classes]
    return min(known, key=lambda cls: (-len(vocabulary.ancestors[cls]), cls)) if known else THING
