"""Numbers that skills change, for planners without numbers: a thing is at a *level*, and a step takes it to another.

A level is a number that a property may have. Planners get a relation between things and levels in place of the
property, and for each change one between the levels before and after it, or a condition on both. A skill that changes
a number gets both levels as parameters: the one that is reached has to exist, so that no number leaves its range.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from msgspec import structs

from skillc_model.conditions import (
    Adjust,
    Assign,
    Compare,
    Condition,
    Effect,
    Expression,
    ForEach,
    Individual,
    PropertyOf,
    Variable,
    exact_value,
    single_effect,
)
from skillc_model.pddl.kebab import to_kebab
from skillc_model.read_write import terms_read
from skillc_model.skills import Implementation, Outcome, Post, Skill, SkillLibrary
from skillc_model.traversal import free_variables, walk
from skillc_rdf.vocabulary.types import (
    ClassTerm,
    ClassType,
    NumberType,
    PlainType,
    PropertyTerm,
    RelationTerm,
    Signature,
    Vocabulary,
)

LEVEL, NOW, AMOUNT, AFTER = "--level", "--now", "--amount", "--after-"
"""What ends the IRIs of the class of the levels of a property, of the relation to the one that a thing is at, of the
number that a level is, and, with more behind it, of the relation to the level after a change."""


class LevelChange(NamedTuple):
    """A change of a number: its value afterwards, read in the state before, with the classes of the names in it.

    `relation` is the one from the level before to the one after it, if the value depends on the level alone. A change
    `of_many` gives the number of all individuals of a class that fulfil a condition the same value.
    """

    property: str
    subject: Variable | Individual
    value: Expression
    classes: Mapping[str, str]
    relation: str | None
    effect: Adjust | Assign
    of_many: bool = False


def number_of(change: LevelChange) -> PropertyOf:
    """Return the number that is changed."""
    return PropertyOf(change.subject, change.property)


def is_level_parameter(name: str) -> bool:
    """Whether a parameter is a level: no name of an author has a dot."""
    return "." in name


def list_level_classes(vocabulary: Vocabulary) -> tuple[str, ...]:
    """Return the classes of levels."""
    return tuple(iri for iri in vocabulary.classes if iri.endswith(LEVEL))


def find_changes(skill: Skill, vocabulary: Vocabulary) -> Iterator[LevelChange]:
    """Yield the changes of numbers of a skill that levels can express."""
    classes = {
        each.name: each.type.iri
        for each in skill.parameters
        if each.direction in ("in", "infer") and isinstance(each.type, ClassType)
    }
    results: tuple[Post | Outcome, ...] = (*skill.post, *skill.outcomes)
    for result in results:
        for number, effect in enumerate(result.effects):
            ending = f"{to_kebab(skill.name)}-{result.label}" + (f"-{number}" if number else "")
            change = _find_change(effect, classes, ending)
            if change is not None and _is_plain_number(change.property, vocabulary) and _is_known(change):
                yield change


def _find_change(effect: Effect, classes: Mapping[str, str], ending: str) -> LevelChange | None:
    single, of_many = single_effect(effect), isinstance(effect, ForEach)
    value = _value_after(single)
    if value is None or not isinstance(single, Adjust | Assign):
        return None
    relation = f"{single.property}{AFTER}{ending}" if not of_many and _is_of_itself(single, value) else None
    return LevelChange(single.property, single.subject, value, classes, relation, single, of_many)


def _value_after(effect: Effect) -> Expression | None:
    match effect:
        case Adjust():
            return exact_value(effect)
        case Assign(value=value):
            return value
        case _:
            return None


def _is_of_itself(effect: Adjust | Assign, value: Expression) -> bool:
    """Whether a value depends on the number before and on nothing else."""
    own = PropertyOf(effect.subject, effect.property)
    parts = tuple(walk(value))
    return own in parts and all(each in (own, own.of) or not isinstance(each, PropertyOf | Variable) for each in parts)


def _is_known(change: LevelChange) -> bool:
    """Whether a planner knows what a change reads: its subject and the properties of things that it binds."""
    reads = [each for each in walk(change.value) if isinstance(each, PropertyOf)]
    named = {*free_variables(change.value), *(() if change.of_many else free_variables(number_of(change)))}
    return named <= change.classes.keys() and all(map(is_of_term, reads))


def is_of_term(read: PropertyOf) -> bool:
    """Whether a number is one of a thing that is named."""
    return isinstance(read.of, Variable | Individual)


def _is_plain_number(iri: str, vocabulary: Vocabulary) -> bool:
    term = vocabulary.properties.get(iri)
    if term is None or term.computed_by is not None or not term.functional:
        return False
    return isinstance(term.type, NumberType) or term.type == PlainType("Int")


def split_by_use(
    changes: Iterable[LevelChange], library: SkillLibrary, goal: Condition | None
) -> tuple[frozenset[str], frozenset[str]]:
    """Return the changed numbers that decide what can be planned, and those of which nothing asks how great they are.

    Whether these have a value never changes, as every change of them adds to the value before.
    """
    changes = tuple(changes)
    changed = {each.property for each in changes}
    read = {iri for skill in library.skills.values() if skill.planned for iri in _numbers_read_by(skill, library)}
    read |= frozenset(_numbers_read(goal)) if goal is not None else frozenset()
    read |= {each.property for each in changes if each.property not in terms_read(each.value)}
    before = set[str]()
    while before != read:
        before = set(read)
        read |= {iri for each in changes if each.property in read for iri in terms_read(each.value)}
    return frozenset(changed & read), frozenset(changed - read)


def _numbers_read_by(skill: Skill, library: SkillLibrary) -> Iterator[str]:
    """Yield the numbers on which it depends whether a skill can start, what it does to which things, and how long."""
    described: tuple[Skill | Implementation, ...] = (skill, *library.implementations_of(skill.name))
    for one in described:
        for each in (*one.pre, *one.hold):
            yield from _numbers_read(each.condition)
        yield from terms_read(one.duration) if one.duration is not None else ()
    for effect in (effect for post in skill.post for effect in post.effects if isinstance(effect, ForEach)):
        yield from _numbers_read(effect.when)


def _numbers_read(condition: Condition) -> Iterator[str]:
    """Yield the properties of which a condition compares the values."""
    for each in walk(condition):
        if isinstance(each, Compare):
            yield from terms_read(each)


def add_levels(vocabulary: Vocabulary, numbers: Iterable[str], changes: Iterable[LevelChange]) -> Vocabulary:
    """Return a vocabulary with the classes of levels, and the relations to and between them."""
    classes, relations = dict(vocabulary.classes), dict(vocabulary.relations)
    properties = dict(vocabulary.properties)
    for iri in sorted(numbers):
        term, level = properties[iri], iri + LEVEL
        classes[level] = ClassTerm(iri=level)
        signatures = tuple(Signature(each, level) for each in term.domains)
        relations[iri + NOW] = RelationTerm(iri=iri + NOW, signatures=signatures, functional=True)
        properties[iri + AMOUNT] = PropertyTerm(iri=iri + AMOUNT, domains=(level,), type=term.type)
    for each in changes:
        if each.relation is not None:
            level = each.property + LEVEL
            relations[each.relation] = RelationTerm(iri=each.relation, signatures=(Signature(level, level),))
    return structs.replace(vocabulary, classes=classes, relations=relations, properties=properties)
