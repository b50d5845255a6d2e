"""The class hierarchy as PDDL needs it: a tree. What the tree cannot say becomes static unary predicates."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import cached_property

from skillc_compiler.library.pddl.domain import ROOT, PlanningType
from skillc_compiler.library.vocabulary import THING, Vocabulary


class Hierarchy:
    """Every class below the deepest of its parents.

    `combined` are the sets of classes of those individuals that have several, which makes one more kind of class with
    several parents each.
    """

    def __init__(self, vocabulary: Vocabulary, names: Mapping[str, str], combined: Collection[frozenset[str]] = ()):
        self._vocabulary = vocabulary
        self._names = names
        self._combined = sorted(combined, key=sorted)
        self._covers: dict[str, str] = {}

    @cached_property
    def _parents(self) -> dict[str, str]:
        return {iri: self._deepest(term.parents) for iri, term in self._vocabulary.classes.items()}

    def _deepest(self, classes: Iterable[str]) -> str:
        known = [cls for cls in classes if cls in self._vocabulary.classes]
        return min(known, key=lambda cls: (-len(self._vocabulary.ancestors[cls]), cls)) if known else THING

    @cached_property
    def types(self) -> tuple[PlanningType, ...]:
        """All classes as types, by name."""
        types = [
            PlanningType(self._name(iri), self._name(parent), iri, len(self._chain(iri)) - 2)
            for iri, parent in self._parents.items()
        ]
        return tuple(sorted(types, key=lambda each: each.name))

    def type_name(self, cls: str) -> str:
        """Return the most specific type that has every individual of the class."""
        return self._name(self._cover(cls))

    def is_exact(self, cls: str) -> bool:
        """Whether the type that has every individual of the class has no others."""
        return self._cover(cls) == cls

    def common(self, classes: Iterable[str]) -> str:
        """Return the deepest class that is above all of these."""
        shared = frozenset.intersection(*(self._vocabulary.ancestors.get(cls, frozenset({THING})) for cls in classes))
        return self._deepest(shared)

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
            min(known, key=lambda each: (2 - len(self._chain(each)), self._name(each)))
            for known in ([each for each in kinds if each in ancestors] for kinds in self._combined)
            if any(cls in ancestors[each] for each in known)
        ]
        return classes + mixed
