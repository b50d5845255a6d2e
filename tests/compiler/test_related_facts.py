"""Facts that exclude each other are always about a common topic, so that comparing only those misses nothing."""

from __future__ import annotations

from random import Random

from fuzz.kinds.texts import vocabulary
from skillc_compiler.logic.conflicts import Conflicts
from skillc_compiler.logic.conjunctions import TypedFact
from skillc_compiler.logic.related import topics_of_fact
from skillc_compiler.program.expressions import TypedCondition
from skillc_dsl.source import Span
from skillc_model.conditions import (
    Anything,
    Compare,
    Condition,
    HasProperty,
    Holds,
    Individual,
    IsA,
    Literal,
    PropertyOf,
    Variable,
)
from skillc_rdf.vocabulary.types import local_name

CONFLICTS = Conflicts(vocabulary())
NAMED = (Variable("a"), Variable("b"), Individual("http://e/a"), Individual("http://e/b"))
RELATIONS = [iri for iri in sorted(CONFLICTS.vocabulary.relations) if local_name(iri) in ("contain", "hasA", "at")]
OPERATORS = ("==", "!=", "<", "<=", ">", ">=")
VALUES = (1.0, 2.0, 3.0, "a", "b", True, False)


def test_facts_that_exclude_each_other_have_a_common_topic() -> None:
    random = Random(0)
    excluding = 0
    for _ in range(40_000):
        one, other = _fact(random), _fact(random)
        if CONFLICTS.exclude(one, other):
            excluding += 1
            about = {topic for topic, _ in topics_of_fact(CONFLICTS, one)}
            sought = {topic for _, topic in topics_of_fact(CONFLICTS, other)}
            assert about & sought, f"{one.meaning} {one.holds}, {other.meaning} {other.holds}"
    assert excluding > 100


def _fact(random: Random) -> TypedFact:
    place = Span("a.skill", 1, 1, 1, 2)
    condition = TypedCondition(_meaning(random), place)
    return TypedFact(condition, random.random() < 0.6, condition)


def _meaning(random: Random) -> Condition:
    words = CONFLICTS.vocabulary
    subject, property_ = random.choice(NAMED), sorted(words.properties)[random.randrange(2)]
    match random.randrange(6):
        case 0 | 1 | 2:
            ends = random.choices((*NAMED, Anything()), k=2)
            return Holds(ends[0], random.choice(RELATIONS), ends[1])
        case 3:
            sides = [PropertyOf(subject, property_), Literal(random.choice(VALUES))]
            random.shuffle(sides)
            return Compare(sides[0], random.choice(OPERATORS), sides[1])
        case 4:
            return HasProperty(subject, property_)
        case _:
            return IsA(subject, random.choice(sorted(words.classes)))
