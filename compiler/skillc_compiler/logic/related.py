"""What a fact or an effect may exclude: only what is about the same things is compared, not all pairs."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from heapq import merge
from typing import Generic, TypeAlias, TypeVar, assert_never

from skillc_compiler.logic.bounds import Bound, constant_bound
from skillc_compiler.logic.conflicts import Conflicts, Link
from skillc_compiler.logic.conjunctions import TypedFact
from skillc_model.conditions import (
    Adjust,
    Anything,
    Assert,
    Assign,
    Effect,
    HasProperty,
    Holds,
    Individual,
    IsA,
    PropertyOf,
    Retract,
    Term,
)

T = TypeVar("T")
Topic: TypeAlias = tuple[object, ...]
Topics: TypeAlias = Iterable[tuple[Topic, Topic]]
"""What something is about, each with what something that excludes it is about."""


class TopicIndex(Generic[T]):
    """Things in order, found by what they are about."""

    def __init__(self) -> None:
        self._things: list[T] = []
        self._about: defaultdict[Topic, list[int]] = defaultdict(list)

    def add(self, thing: T, topics: Topics) -> None:
        """Add the next thing."""
        for topic, _ in topics:
            self._about[topic].append(len(self._things))
        self._things.append(thing)

    def related(self, topics: Topics) -> Iterator[T]:
        """Yield, in order, the things that may exclude one with these topics."""
        last = -1
        for number in merge(*(self._about[other] for _, other in topics if other in self._about)):
            if number != last:
                yield self._things[number]
            last = number


class RelatedFacts:
    """Different facts in order, of which only related ones are compared with another; equal ones count once."""

    def __init__(self, conflicts: Conflicts) -> None:
        self._conflicts = conflicts
        self._facts: dict[tuple[object, bool], TypedFact] = {}
        self._index = TopicIndex[tuple[object, bool]]()

    def add(self, fact: TypedFact) -> None:
        """Add a fact; one that means the same as an earlier one takes its place."""
        key = fact.meaning, fact.holds
        if key not in self._facts:
            self._index.add(key, topics_of_fact(self._conflicts, fact))
        self._facts[key] = fact

    def first_excluding(self, fact: TypedFact) -> TypedFact | None:
        """Return the first fact that cannot be true together with this one, None if there is none."""
        others = (self._facts[key] for key in self._index.related(topics_of_fact(self._conflicts, fact)))
        return next((other for other in others if self._conflicts.exclude(other, fact)), None)


def topics_of_fact(conflicts: Conflicts, fact: TypedFact) -> Iterator[tuple[Topic, Topic]]:
    """Yield the topics of a fact: facts that exclude each other always share one."""
    meaning, holds = fact.meaning, fact.holds
    yield ("same", meaning, holds), ("same", meaning, not holds)
    match meaning:
        case Holds() if holds:
            for link in conflicts.implied(meaning):
                yield from _present(link)
                yield from _exclusive(conflicts, link)
        case Holds():
            yield from _absent(meaning)
        case HasProperty(subject=subject, property=name) if not holds:
            yield ("no value", subject, name), ("value", subject, name)
        case IsA(subject=subject):
            yield ("class", subject), ("class", subject)
    bound = constant_bound(meaning)
    if bound is not None:
        yield from _of_bound(bound if holds else bound.opposite())
    match bound:
        case Bound(of=PropertyOf(of=of, property=name)) if holds:
            yield ("value", of, name), ("no value", of, name)


def topics_of_effect(conflicts: Conflicts, effect: Effect) -> Iterator[tuple[Topic, Topic]]:
    """Yield the topics of an effect: effects that contradict each other always share one."""
    match effect:
        case Assert(subject=subject, relation=relation, object=object_):
            for link in conflicts.implied(Holds(subject, relation, object_)):
                yield from _present(link)
                term = conflicts.vocabulary.relations[link.relation]
                if term.functional:
                    yield _both("objects", link.relation, link.subject)
                if term.inverse_functional:
                    yield _both("subjects", link.relation, link.object)
        case Retract(subject=subject, relation=relation, object=object_):
            yield from _absent(Holds(subject, relation, object_))
        case Assign(subject=subject, property=name) | Adjust(subject=subject, property=name):
            yield _both("values", subject, name)


def _of_bound(bound: Bound) -> Iterator[tuple[Topic, Topic]]:
    """Yield the topics of a bound; two from the same side always overlap."""
    of, value = bound.of, bound.value
    match bound.operator:
        case "<" | "<=":
            yield ("below", of), ("above", of)
            yield ("limit", of), ("equal", of)
        case ">" | ">=":
            yield ("above", of), ("below", of)
            yield ("limit", of), ("equal", of)
        case "==":
            yield _both("equal", of)
            yield ("equal", of), ("limit", of)
            yield ("equal to", of, value), ("unequal to", of, value)
        case "!=":
            yield ("unequal to", of, value), ("equal to", of, value)
        case _:
            assert_never(bound.operator)


def _exclusive(conflicts: Conflicts, link: Link) -> Iterator[tuple[Topic, Topic]]:
    relation, subject, object_ = link.relation, link.subject, link.object
    term = conflicts.vocabulary.relations[relation]
    if term.asymmetric:
        yield ("link", relation, subject, object_), ("link", relation, object_, subject)
    if term.functional and isinstance(object_, Individual):
        yield _both("objects", relation, subject)
    if term.inverse_functional and isinstance(subject, Individual):
        yield _both("subjects", relation, object_)


def _present(link: Link) -> Iterator[tuple[Topic, Topic]]:
    for subject in (link.subject, None):
        for object_ in (link.object, None):
            yield ("present", link.relation, subject, object_), ("absent", link.relation, subject, object_)


def _absent(fact: Holds) -> Iterator[tuple[Topic, Topic]]:
    place = fact.relation, _unless_anything(fact.subject), _unless_anything(fact.object)
    yield ("absent", *place), ("present", *place)


def _unless_anything(term: Term) -> Term | None:
    return None if isinstance(term, Anything) else term


def _both(*topic: object) -> tuple[Topic, Topic]:
    return topic, topic
