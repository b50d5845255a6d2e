"""What a step of a plan reads of the world, and what it changes: two steps that touch nothing in common may overlap."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

import msgspec

from skillc_compiler.library.conditions import (
    Condition,
    HasProperty,
    Holds,
    Individual,
    Invoke,
    PropertyOf,
    Variable,
)
from skillc_compiler.library.reading import walk
from skillc_runtime.world.state.changes import AddRelation, Change, ClearProperty, RemoveRelation, SetProperty
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class Fact:
    """Facts of a relation or property, by IRI, about these individuals; None stands for any."""

    term: str | None
    subject: str | None = None
    object: str | None = None

    def meets(self, other: Fact) -> bool:
        """Whether some fact may be one of both."""
        return all(
            one is None or two is None or one == two
            for one, two in ((self.term, other.term), (self.subject, other.subject), (self.object, other.object))
        )


EVERYTHING = Fact(None)


@dataclass(frozen=True, slots=True)
class Touched:
    """What a step reads, the facts it changes, the facts it settles, and the devices it has for itself.

    What is settled includes what a functional relation would lose: whoever else settles it comes before or after.
    """

    reads: frozenset[Fact]
    changes: frozenset[Fact]
    settles: frozenset[Fact]
    devices: frozenset[str]

    def conflicts(self, other: Touched) -> bool:
        """Whether the order of the two matters."""
        return (
            bool(self.devices & other.devices)
            or _meet(self.settles, other.settles)
            or _meet(self.changes, other.reads)
            or _meet(other.changes, self.reads)
        )

    def is_disturbed_by(self, other: Touched) -> bool:
        """Whether the other changes what this one reads."""
        return _meet(other.changes, self.reads)

    def shares_with(self, other: Touched) -> str | None:
        """Return what the two cannot have both at the same time, in words: a device, or facts that both settle."""
        common = self.devices & other.devices
        if common:
            return f"both lock {', '.join(sorted(common))}"
        return "both settle the same facts" if _meet(self.settles, other.settles) else None


def _meet(some: Iterable[Fact], others: Iterable[Fact]) -> bool:
    others = tuple(others)
    return any(one.meets(other) for one in some for other in others)


def read_by(condition: Condition, individuals: Mapping[str, str], state: WorldState) -> Iterator[Fact]:
    """Yield what decides whether a condition holds; names that stand for no known individual may stand for any."""
    for each in walk(condition):
        match each:
            case Holds(relation=relation) if relation in state.axioms.computed:
                known = state.vocabulary.relations[relation].computed_from
                yield from map(Fact, known) if known else (EVERYTHING,)
            case Holds(subject, relation, object_):
                yield Fact(relation, _known(subject, individuals), _known(object_, individuals))
            case HasProperty(subject, property_) | PropertyOf(subject, property_):
                computed = state.vocabulary.properties[property_].computed_by is not None
                yield EVERYTHING if computed else Fact(property_, _known(subject, individuals))
            case Invoke():
                yield EVERYTHING
            case _:
                pass


def changed_between(before: WorldState, after: WorldState) -> Iterator[Fact]:
    """Yield the facts in which two versions of the world differ; of a transitive relation, any."""
    for relation, links in after.facts.items():
        if links is not before.facts[relation]:
            if relation in after.axioms.transitive:
                yield Fact(relation)
            for subject, object_ in set(links.pairs()) ^ set(before.facts[relation].pairs()):
                yield Fact(relation, subject, object_)
    for property_, table in after.stored.items():
        if table is not before.stored[property_]:
            changed = set(table.items()) ^ set(before.stored[property_].items())
            yield from (Fact(property_, individual) for individual in {each for each, _ in changed})


def settled_by(change: Change, state: WorldState) -> Iterator[Fact]:
    """Yield all facts that a change decides, those included that it takes away."""
    match change:
        case AddRelation(subject, relation, object_) | RemoveRelation(subject, relation, object_):
            for related, flipped in {*state.axioms.implied[relation], *state.axioms.sources[relation]}:
                yield from _settled(related, *((object_, subject) if flipped else (subject, object_)), state)
        case SetProperty(individual, property_, _) | ClearProperty(individual, property_):
            yield Fact(property_, individual)
        case _:
            yield EVERYTHING


def _settled(relation: str, subject: str, object_: str, state: WorldState) -> Iterator[Fact]:
    term = state.vocabulary.relations[relation]
    if relation not in state.axioms.transitive:
        yield Fact(relation, subject, object_)
    if term.functional:
        yield Fact(relation, subject, None)
    if term.inverse_functional:
        yield Fact(relation, None, object_)


def _known(term: msgspec.Struct, individuals: Mapping[str, str]) -> str | None:
    match term:
        case Individual(iri):
            return iri
        case Variable(name):
            return individuals.get(name)
        case _:
            return None
