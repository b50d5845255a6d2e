"""What conditions read, and what the effects of skills write: as terms by IRI, and as patterns of facts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import assert_never

import msgspec

from skillc_model.conditions import (
    Assert,
    Assign,
    Compare,
    Condition,
    Effect,
    Expression,
    HasProperty,
    Holds,
    Individual,
    Invoke,
    PropertyOf,
    Retract,
    Variable,
)
from skillc_model.skills import Implementation, Post, Skill, SkillLibrary
from skillc_model.traversal import walk
from skillc_rdf.vocabulary.types import Vocabulary


@dataclass(frozen=True, slots=True)
class FactPattern:
    """Facts of a relation or property, by IRI, about these individuals; None stands for any."""

    term: str | None
    subject: str | None = None
    object: str | None = None

    def meets(self, other: FactPattern) -> bool:
        """Whether some fact may be one of both."""
        return all(
            one is None or two is None or one == two
            for one, two in ((self.term, other.term), (self.subject, other.subject), (self.object, other.object))
        )


EVERYTHING = FactPattern(None)


@dataclass(frozen=True, slots=True)
class ReadWriteSet:
    """What a step reads, the facts it writes, the facts it settles, and the devices it has for itself.

    What is settled includes what a functional relation would lose: whoever else settles it comes before or after.
    """

    reads: frozenset[FactPattern]
    writes: frozenset[FactPattern]
    settles: frozenset[FactPattern]
    devices: frozenset[str]

    def conflicts(self, other: ReadWriteSet) -> bool:
        """Whether the order of the two matters."""
        return (
            bool(self.devices & other.devices)
            or _meet(self.settles, other.settles)
            or _meet(self.writes, other.reads)
            or _meet(other.writes, self.reads)
        )

    def is_disturbed_by(self, other: ReadWriteSet) -> bool:
        """Whether the other writes what this one reads."""
        return _meet(other.writes, self.reads)

    def shares_with(self, other: ReadWriteSet) -> str | None:
        """Return what the two cannot have both at the same time, in words: a device, or facts that both settle."""
        common = self.devices & other.devices
        if common:
            return f"both lock {', '.join(sorted(common))}"
        return "both settle the same facts" if _meet(self.settles, other.settles) else None


@dataclass(frozen=True, slots=True)
class UniqueSide:
    """A relation that follows from an asserted one and lets one thing stand on the other side of `side` only.

    `side` is 0 for its subject and 1 for its object; `flipped` says that it follows from object to subject.
    """

    relation: str
    flipped: bool
    side: int

    @property
    def fixed(self) -> int:
        """The side of the asserted relation, 0 or 1, of which the thing keeps no other partner."""
        return int(self.side != self.flipped)


def facts_read(
    condition: Condition | Expression, individuals: Mapping[str, str], vocabulary: Vocabulary
) -> Iterator[FactPattern]:
    """Yield what decides whether a condition holds; names that stand for no known individual may stand for any."""
    for each in walk(condition):
        match each:
            case Holds(relation=relation) if vocabulary.is_computed(relation):
                known = vocabulary.relations[relation].computed_from
                yield from map(FactPattern, known) if known else (EVERYTHING,)
            case Holds(subject, relation, object_):
                yield FactPattern(relation, _individual(subject, individuals), _individual(object_, individuals))
            case HasProperty(subject, property_) | PropertyOf(subject, property_):
                computed = vocabulary.is_computed(property_)
                yield EVERYTHING if computed else FactPattern(property_, _individual(subject, individuals))
            case Invoke():
                yield EVERYTHING


def terms_read(condition: Condition | Expression) -> frozenset[str]:
    """Return the IRIs of the relations and properties that decide whether a condition holds or what a value is."""
    read: set[str] = set()
    for each in walk(condition):
        match each:
            case Holds(relation=iri) | HasProperty(property=iri) | PropertyOf(property=iri):
                read.add(iri)
    return frozenset(read)


def terms_read_by(skill: Skill, library: SkillLibrary) -> frozenset[str]:
    """Return what decides whether a skill can start, how long it takes, and whether its effects are allowed."""
    read: set[str] = set()
    described: tuple[Skill | Implementation, ...] = (skill, *library.implementations_of(skill.name))
    for one in described:
        for requirement in (*one.pre, *one.hold):
            read |= terms_read(requirement.condition)
        if one.duration is not None:
            read |= terms_read(one.duration)
    vocabulary = library.vocabulary
    for post in skill.post:
        read |= terms_read(post.condition)
        asserted = (effect.relation for effect in post.effects if isinstance(effect, Assert))
        implied = (each.relation for relation in asserted for each in vocabulary.closure.implied[relation])
        read |= {iri for iri in implied if vocabulary.relations[iri].asymmetric}
    return frozenset(read)


def terms_written(posts: Iterable[Post], vocabulary: Vocabulary) -> frozenset[str]:
    """Return the canonical relations and the properties that posts change, by themselves or through axioms.

    A measured number counts too: no effect tells its value, yet nothing may take the old one for granted.
    """
    written: set[str] = set()
    for post in posts:
        written.update(*(terms_written_by(effect, vocabulary) for effect in post.effects))
        match post:
            case Post(effects=(), condition=Compare(left=PropertyOf(property=iri)) | HasProperty(property=iri)):
                written.add(iri)
    return frozenset(written)


def terms_written_by(effect: Effect, vocabulary: Vocabulary) -> frozenset[str]:
    """Return the canonical relations, or the property, that an effect changes: of a relation, those it takes away too.

    Whatever these imply changes with them, which `may_change` knows.
    """
    closure = vocabulary.closure
    match effect:
        case Assign(property=iri):
            return frozenset({iri})
        case Retract(relation=iri):
            return frozenset(each.relation for each in closure.canonical_sources.get(iri, ()))
        case Assert(relation=iri):
            unique = unique_sides(iri, vocabulary)
            lost = {each.relation for above in unique for each in closure.canonical_sources[above.relation]}
            return frozenset({closure.canonical(iri).relation, *lost})
        case _:
            assert_never(effect)


def unique_sides(relation: str, vocabulary: Vocabulary) -> tuple[UniqueSide, ...]:
    """Return what asserting the relation may retract."""
    found: list[UniqueSide] = []
    for iri, flipped in vocabulary.closure.implied.get(relation, ()):
        term = vocabulary.relations[iri]
        found += [UniqueSide(iri, flipped, 0)] if term.functional else []
        found += [UniqueSide(iri, flipped, 1)] if term.inverse_functional else []
    return tuple(found)


def changing_terms(library: SkillLibrary) -> frozenset[str]:
    """Return the relations and properties that some skill changes, with all that changes with them by axioms."""
    vocabulary = library.vocabulary
    posts = (post for implementation in library.implementations.values() for post in implementation.post)
    written = terms_written(posts, vocabulary)
    terms = (*vocabulary.relations, *vocabulary.properties)
    return frozenset(iri for iri in terms if may_change(iri, written, vocabulary))


def may_change(term: str, written: frozenset[str], vocabulary: Vocabulary) -> bool:
    """Whether what is stated of a relation or property may change where these are written, as of `terms_written`."""
    if term in vocabulary.relations:
        return any(each.relation in written for each in vocabulary.closure.canonical_sources[term])
    return term in written


def is_fixed(item: Condition | Expression, changing: frozenset[str], vocabulary: Vocabulary) -> bool:
    """Whether a condition or expression, once its names are bound, is the same now as at any later time.

    `changing` are the terms that skills change, as of `changing_terms`. What is computed may follow from anything.
    """
    if any(isinstance(each, Invoke) for each in walk(item)):
        return False
    read = terms_read(item)
    return changing.isdisjoint(read) and not any(map(vocabulary.is_computed, read))


def _meet(some: Iterable[FactPattern], others: Iterable[FactPattern]) -> bool:
    others = tuple(others)
    return any(one.meets(other) for one in some for other in others)


def _individual(term: msgspec.Struct, individuals: Mapping[str, str]) -> str | None:
    match term:
        case Individual(iri):
            return iri
        case Variable(name):
            return individuals.get(name)
        case _:
            return None
