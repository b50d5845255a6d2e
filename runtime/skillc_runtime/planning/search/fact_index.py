"""Facts in the order in which they became known, found by their predicate and by one of their objects."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

from skillc_model.pddl.formulas import Atom

Terms: TypeAlias = tuple[str, ...]


class FactIndex:
    """The objects of facts, by predicate, and by predicate, place and the object there."""

    def __init__(self, facts: Iterable[Atom]) -> None:
        self._in_order: list[tuple[str, Terms]] = []
        self._by_predicate: dict[str, list[Terms]] = defaultdict(list)
        self._by_object: dict[tuple[str, int, str], list[Terms]] = defaultdict(list)
        for each in facts:
            self.add(each)

    @property
    def count(self) -> int:
        """How many facts are known."""
        return len(self._in_order)

    def add(self, fact: Atom) -> None:
        """Add a fact that is not known yet."""
        self._in_order.append((fact.predicate, fact.terms))
        self._by_predicate[fact.predicate].append(fact.terms)
        for place, name in enumerate(fact.terms):
            self._by_object[fact.predicate, place, name].append(fact.terms)

    def of(self, predicate: str) -> Sequence[Terms]:
        """Return the objects of all facts of a predicate."""
        return self._by_predicate.get(predicate, ())

    def since(self, count: int) -> Sequence[tuple[str, Terms]]:
        """Return predicate and objects of the facts after the first `count` ones."""
        return self._in_order[count:]

    def find_fewest(self, atoms: Iterable[Atom], values: Mapping[str, str]) -> tuple[Atom, Sequence[Terms]]:
        """Return the atom of which the fewest facts agree with the value of a variable, or a constant, and these."""
        return min(((each, self._find(each, values)) for each in atoms), key=lambda found: len(found[1]))

    def _find(self, atom: Atom, values: Mapping[str, str]) -> Sequence[Terms]:
        fitting = self.of(atom.predicate)
        for place, term in enumerate(atom.terms):
            name = values.get(term, term)
            if not name.startswith("?"):
                fewer = self._by_object.get((atom.predicate, place, name), ())
                fitting = fewer if len(fewer) < len(fitting) else fitting
        return fitting
