"""The classes of the individuals that names stand for, and which two can never be the same."""

from __future__ import annotations

from dataclasses import dataclass, field

from skillc_compiler.analysis.axioms import Axioms
from skillc_compiler.analysis.state import State, Thing
from skillc_model.conditions import Individual, IsA, Same, Variable
from skillc_rdf.vocabulary.types import THING, Vocabulary

SOME = "?"


@dataclass(frozen=True)
class Sorts:
    """The class of each name, as far as known. A name that begins with `?` is some individual of the class after it."""

    vocabulary: Vocabulary
    axioms: Axioms
    classes: dict[str, str] = field(default_factory=dict)

    def class_of(self, thing: Thing) -> str:
        """Return the class by declaration; that of an individual is not known."""
        if isinstance(thing, Individual):
            return THING
        return thing.name[1:] if thing.name.startswith(SOME) else self.classes.get(thing.name, THING)

    def is_computed(self, relation: str) -> bool:
        """Whether a relation follows from other facts by a computation."""
        return relation in self.vocabulary.relations and self.vocabulary.is_computed(relation)

    def is_decided_by(self, relation: str, written: frozenset[str]) -> bool:
        """Whether a computed relation may change with one of these relations, by their one name, and properties."""
        if not self.is_computed(relation):
            return False
        known = self.vocabulary.relations[relation].computed_from
        return not known or not written.isdisjoint(self.axioms.name.get(each, (each, False))[0] for each in known)

    def is_a(self, state: State, thing: Thing, cls: str) -> bool | None:
        """Whether the individual is of the class."""
        if self.vocabulary.is_a(self.class_of(thing), cls):
            return True
        known = state.facts.get(IsA(thing, cls))
        if known is not None:
            return known
        if any(self.vocabulary.is_a(each, cls) for each in self._classes(state, thing)):
            return True
        if any(self.vocabulary.disjoint(each, cls) for each in self._classes(state, thing)):
            return False
        return None

    def differ(self, state: State, one: Thing, other: Thing) -> bool:
        """Whether the two are certainly not the same individual."""
        if one == other:
            return False
        if isinstance(one, Individual) and isinstance(other, Individual):
            return True
        if state.facts.get(same(one, other)) is False:
            return True
        return any(
            self.vocabulary.disjoint(mine, yours)
            for mine in self._classes(state, one)
            for yours in self._classes(state, other)
        )

    def _classes(self, state: State, thing: Thing) -> list[str]:
        known = [
            fact.cls for fact, true in state.facts.items() if true and isinstance(fact, IsA) and fact.subject == thing
        ]
        return [self.class_of(thing), *known]


def same(one: Thing, other: Thing) -> Same:
    """Return the condition that both are the same, in the one form in which it is kept."""
    first, second = sorted((one, other), key=_order)
    return Same(first, second)


def some(cls: str) -> Variable:
    """Return a name for some individual of a class, whichever."""
    return Variable(SOME + cls)


def _order(thing: Thing) -> tuple[bool, str]:
    return (False, thing.iri) if isinstance(thing, Individual) else (True, thing.name)
