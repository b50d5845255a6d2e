"""What conditions read and effects write: the IRIs of terms, and patterns of facts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import assert_never

import msgspec

from skillc_model.conditions import (
    Adjust,
    Assert,
    Assign,
    Compare,
    Condition,
    Effect,
    Expression,
    ForEach,
    HasProperty,
    Holds,
    Individual,
    Invoke,
    PropertyOf,
    Retract,
    Variable,
    bounds_of,
    single_effect,
)
from skillc_model.skills import Implementation, Outcome, Post, Skill, SkillLibrary
from skillc_model.traversal import walk
from skillc_rdf.vocabulary.types import Vocabulary


class FactPattern(msgspec.Struct, frozen=True):
    """A pattern that matches facts by the IRIs of term, subject and object; None matches any."""

    term: str | None
    subject: str | None = None
    object: str | None = None

    def meets(self, other: FactPattern) -> bool:
        """Whether some fact matches both patterns."""
        return all(
            one is None or two is None or one == two
            for one, two in ((self.term, other.term), (self.subject, other.subject), (self.object, other.object))
        )


EVERYTHING = FactPattern(None)


class ReadWriteSet(msgspec.Struct, frozen=True):
    """The facts that a step reads, writes and settles, and the devices that it locks.

    Settled facts include those that a functional relation loses. Two steps that settle the same fact must be ordered.
    """

    reads: frozenset[FactPattern]
    writes: frozenset[FactPattern]
    settles: frozenset[FactPattern]
    devices: frozenset[str]

    def conflicts(self, other: ReadWriteSet) -> bool:
        """Whether the two steps must be ordered."""
        return (
            bool(self.devices & other.devices)
            or _meet(self.settles, other.settles)
            or _meet(self.writes, other.reads)
            or _meet(other.writes, self.reads)
        )

    def is_disturbed_by(self, other: ReadWriteSet) -> bool:
        """Whether the other step writes facts that this one reads."""
        return _meet(other.writes, self.reads)

    def shares_with(self, other: ReadWriteSet) -> str | None:
        """Return why the two steps cannot run at the same time (a device or settled facts), None if they can."""
        common = self.devices & other.devices
        if common:
            return f"both lock {', '.join(sorted(common))}"
        return "both settle the same facts" if _meet(self.settles, other.settles) else None


class UniqueSide(msgspec.Struct, frozen=True):
    """A relation implied by an asserted one that allows one partner only for the individual on `side`.

    `side` is 0 for the subject and 1 for the object; `flipped` if the implied relation has the two exchanged.
    """

    relation: str
    flipped: bool
    side: int

    @property
    def fixed(self) -> int:
        """The side of the asserted relation, 0 or 1, whose individual loses its other partners."""
        return int(self.side != self.flipped)


def facts_read(
    condition: Condition | Expression, individuals: Mapping[str, str], vocabulary: Vocabulary
) -> Iterator[FactPattern]:
    """Yield patterns of the facts that a condition depends on; `individuals` are IRIs by variable, others match any."""
    for each in walk(condition):
        match each:
            case Holds(relation=relation) if vocabulary.is_computed(relation):
                known = vocabulary.relations[relation].computed_from
                yield from map(FactPattern, known) if known else (EVERYTHING,)
            case Holds(subject, relation, object_):
                yield FactPattern(relation, _individual(subject, individuals), _individual(object_, individuals))
            case HasProperty(subject, property_) | PropertyOf(subject, property_):
                inputs = vocabulary.inputs_of(property_)
                if vocabulary.is_computed(property_) and not inputs:
                    yield EVERYTHING
                else:
                    who = _individual(subject, individuals)
                    yield from (FactPattern(iri, who) for iri in inputs or (property_,))
            case Invoke():
                yield EVERYTHING


def terms_read(condition: Condition | Expression) -> frozenset[str]:
    """Return the IRIs of the relations and properties that a condition or an expression reads."""
    read: set[str] = set()
    for each in walk(condition):
        match each:
            case Holds(relation=iri) | HasProperty(property=iri) | PropertyOf(property=iri):
                read.add(iri)
    return frozenset(read)


def terms_read_by(skill: Skill, library: SkillLibrary) -> frozenset[str]:
    """Return the terms that decide whether a skill can start, its duration, and whether its effects are allowed."""
    read: set[str] = set()
    described: tuple[Skill | Implementation, ...] = (skill, *library.implementations_of(skill.name))
    for one in described:
        for requirement in (*one.pre, *one.hold):
            read |= terms_read(requirement.condition)
        if one.duration is not None:
            read |= terms_read(one.duration)
    vocabulary = library.vocabulary
    for result in skill.results:
        read |= terms_read(result.condition)
        for effect in result.effects:
            read |= terms_read(effect.when) if isinstance(effect, ForEach) else frozenset()
            read = read.union(*map(terms_read, bounds_of(single_effect(effect))))
        single = map(single_effect, result.effects)
        asserted = (effect.relation for effect in single if isinstance(effect, Assert))
        implied = (each.relation for relation in asserted for each in vocabulary.closure.implied[relation])
        read |= {iri for iri in implied if vocabulary.relations[iri].asymmetric}
    return frozenset(read)


def terms_written(results: Iterable[Post | Outcome], vocabulary: Vocabulary) -> frozenset[str]:
    """Return the canonical relations and the properties that posts and outcomes change, directly or through axioms.

    A measured number is included: no effect gives its value, but its old value no longer holds.
    """
    written: set[str] = set()
    for result in results:
        written.update(*(terms_written_by(effect, vocabulary) for effect in result.effects))
        match result:
            case Post(effects=(), condition=Compare(left=PropertyOf(property=iri)) | HasProperty(property=iri)):
                written.add(iri)
    return frozenset(written)


def terms_written_by(effect: Effect, vocabulary: Vocabulary) -> frozenset[str]:
    """Return the canonical relations, including those it retracts, or the property that an effect changes.

    Terms that these imply are not included; `may_change` takes them into account.
    """
    closure, single = vocabulary.closure, single_effect(effect)
    match single:
        case Assign(property=iri) | Adjust(property=iri):
            return frozenset({iri})
        case Retract(relation=iri):
            return frozenset(each.relation for each in closure.canonical_sources.get(iri, ()))
        case Assert(relation=iri):
            unique = unique_sides(iri, vocabulary)
            lost = {each.relation for above in unique for each in closure.canonical_sources[above.relation]}
            return frozenset({closure.canonical(iri).relation, *lost})
        case _:
            assert_never(single)


def unique_sides(relation: str, vocabulary: Vocabulary) -> tuple[UniqueSide, ...]:
    """Return the implied relations of which asserting `relation` may retract other facts."""
    found: list[UniqueSide] = []
    for iri, flipped in vocabulary.closure.implied.get(relation, ()):
        term = vocabulary.relations[iri]
        found += [UniqueSide(iri, flipped, 0)] if term.functional else []
        found += [UniqueSide(iri, flipped, 1)] if term.inverse_functional else []
    return tuple(found)


def changing_terms(library: SkillLibrary) -> frozenset[str]:
    """Return the relations and properties that some skill changes, directly or through axioms."""
    vocabulary = library.vocabulary
    posts = (post for implementation in library.implementations.values() for post in implementation.post)
    outcomes = (outcome for skill in library.skills.values() for outcome in skill.outcomes)
    written = terms_written((*posts, *outcomes), vocabulary)
    terms = (*vocabulary.relations, *vocabulary.properties)
    return frozenset(iri for iri in terms if may_change(iri, written, vocabulary))


def may_change(term: str, written: frozenset[str], vocabulary: Vocabulary) -> bool:
    """Whether the facts of a relation or property may change when the terms `written` (from `terms_written`) change."""
    if term in vocabulary.relations:
        return any(each.relation in written for each in vocabulary.closure.canonical_sources[term])
    return term in written


def is_fixed(item: Condition | Expression, changing: frozenset[str], vocabulary: Vocabulary) -> bool:
    """Whether the value of a condition or expression, once its names are bound, never changes.

    `changing` are the terms that skills change, from `changing_terms`. Computed relations may depend on any fact, and
    so may computed properties that do not say on which they depend.
    """
    if any(isinstance(each, Invoke) for each in walk(item)):
        return False
    read = terms_read(item)
    computed = [each for each in read if vocabulary.is_computed(each)]
    inputs = [vocabulary.inputs_of(each) for each in computed if each in vocabulary.properties]
    return len(inputs) == len(computed) and all(inputs) and changing.isdisjoint(read.union(*inputs))


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
