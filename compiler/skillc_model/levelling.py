"""Rewrites libraries and goals for planners without numbers: they read and change levels instead (see `levels`)."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from itertools import count
from typing import NamedTuple, TypeVar

from msgspec import structs

from skillc_model.conditions import (
    Adjust,
    And,
    Assert,
    Assign,
    Compare,
    Condition,
    Effect,
    Exists,
    Expression,
    Forall,
    ForEach,
    HasProperty,
    Holds,
    Individual,
    Not,
    Or,
    PropertyOf,
    SingleEffect,
    Term,
    Variable,
    single_effect,
)
from skillc_model.format_condition import format_expression
from skillc_model.levels import (
    AMOUNT,
    LEVEL,
    NOW,
    LevelChange,
    add_levels,
    find_changes,
    is_of_term,
    number_of,
    split_by_use,
)
from skillc_model.pddl.names import assign_names
from skillc_model.rewriting import map_children
from skillc_model.skills import Implementation, Outcome, Parameter, Requirement, Skill, SkillLibrary
from skillc_model.traversal import walk
from skillc_rdf.vocabulary.types import ClassType, Vocabulary

DescribedT = TypeVar("DescribedT", Skill, Implementation)
ItemT = TypeVar("ItemT", Condition, Expression)
Subject = Variable | Individual


class LevelledLibrary(NamedTuple):
    """A library without numbers that skills change, as far as levels can take their place, and what they replace."""

    library: SkillLibrary
    levelling: Levelling
    changes: tuple[LevelChange, ...]


def level_library(library: SkillLibrary, goal: Condition | None = None) -> LevelledLibrary:
    """Return a library in which planned skills change and read levels in place of numbers; the same without such."""
    changes = {
        name: tuple(find_changes(each, library.vocabulary)) for name, each in library.skills.items() if each.planned
    }
    numbers, idle = split_by_use((each for found in changes.values() for each in found), library, goal)
    levelling = Levelling(numbers, idle, library.vocabulary)
    if not numbers and not idle:
        return LevelledLibrary(library, levelling, ())
    kept = {name: tuple(each for each in found if each.property in numbers) for name, found in changes.items()}
    known = {name: _levels_before(found, levelling) for name, found in kept.items()}
    every = tuple(each for found in kept.values() for each in found)
    levelled = structs.replace(
        library,
        vocabulary=add_levels(library.vocabulary, numbers, every),
        skills={
            name: _level_skill(skill, kept[name], known[name], levelling) if name in kept else skill
            for name, skill in library.skills.items()
        },
        implementations={
            name: _level_conditions(each, known[each.skill], levelling) if each.skill in kept else each
            for name, each in library.implementations.items()
        },
    )
    return LevelledLibrary(structs.replace(levelled, names=assign_names(levelled)), levelling, every)


class Levelling(NamedTuple):
    """Rewrites conditions on numbers into such on levels; of `idle` numbers nothing asks how great they are."""

    numbers: frozenset[str]
    idle: frozenset[str]
    vocabulary: Vocabulary

    def of(self, condition: Condition, known: Mapping[PropertyOf, Variable]) -> Condition:
        """Return a condition that reads levels; those of `known` numbers are bound to variables."""
        match condition:
            case Not() | And() | Or():
                return map_children(condition, lambda part: self.of(part, known))
            case Exists(body=body) | Forall(body=body):
                return structs.replace(condition, body=self.of(body, known))
            case HasProperty(subject=subject, property=iri) if iri in self.numbers:
                return self._has_value(subject, iri, known)
            case Compare():
                return self._compare(condition, known)
            case _:
                return condition

    def _has_value(self, subject: Term, iri: str, known: Mapping[PropertyOf, Variable]) -> Condition:
        level = known.get(PropertyOf(subject, iri)) if isinstance(subject, Variable | Individual) else None
        if level is not None:
            return HasProperty(level, iri + AMOUNT)
        some = Variable(self.name(PropertyOf(subject, iri)) if isinstance(subject, Variable | Individual) else iri)
        return Exists(some.name, iri + LEVEL, And((Holds(subject, iri + NOW, some), HasProperty(some, iri + AMOUNT))))

    def _compare(self, condition: Compare, known: Mapping[PropertyOf, Variable]) -> Condition:
        reads = tuple(dict.fromkeys(self.levels_in(condition)))
        levels = {each: known.get(each, Variable(self.name(each))) for each in reads}
        found: Condition = replace_reads(condition, levels)
        for each in reversed(reads):
            if each not in known:
                here = Holds(subject_of(each), each.property + NOW, levels[each])
                found = Exists(levels[each].name, each.property + LEVEL, And((here, found)))
        return found

    def levels_in(self, item: Condition | Expression) -> tuple[PropertyOf, ...]:
        """Return the numbers that are read of which there are levels."""
        reads = (each for each in walk(item) if isinstance(each, PropertyOf))
        return tuple(each for each in reads if each.property in self.numbers and is_of_term(each))

    def name(self, read: PropertyOf) -> str:
        """Return the name of the level that a number is at."""
        return format_expression(read, self.vocabulary)


def subject_of(read: PropertyOf) -> Subject:
    """Return the thing of which a number is read."""
    assert isinstance(read.of, Variable | Individual), "only numbers of things that are named have levels"
    return read.of


def replace_reads(item: ItemT, levels: Mapping[PropertyOf, Variable]) -> ItemT:
    """Return a condition or an expression that reads the amounts of levels in place of numbers."""
    if isinstance(item, PropertyOf) and item in levels:
        return PropertyOf(levels[item], item.property + AMOUNT)  # type: ignore[return-value]
    return map_children(item, lambda part: replace_reads(part, levels))


def _levels_before(changes: Iterable[LevelChange], levelling: Levelling) -> dict[PropertyOf, Variable]:
    """Return the numbers that changes read or set, each with the variable of its level before."""
    reads = (
        read
        for each in changes
        for read in (*(() if each.of_many else (number_of(each),)), *levelling.levels_in(each.value))
    )
    return {read: Variable(levelling.name(read)) for read in reads}


def _level_skill(
    skill: Skill, changes: tuple[LevelChange, ...], before: Mapping[PropertyOf, Variable], levelling: Levelling
) -> Skill:
    """Return a skill with levels as parameters, whose postconditions say which level is reached."""
    levels: dict[str, str] = {variable.name: read.property + LEVEL for read, variable in before.items()}
    needed: list[Condition] = [
        Holds(subject_of(read), read.property + NOW, variable) for read, variable in before.items()
    ]
    reached: dict[Effect, SingleEffect] = {}
    for each in changes:
        after = Variable(_choose_name(f"{levelling.name(number_of(each))} after", levels))
        levels[after.name] = each.property + LEVEL
        if each.relation is not None:
            needed.append(Holds(before[number_of(each)], each.relation, after))
        else:
            amount = PropertyOf(after, each.property + AMOUNT)
            needed.append(Compare(amount, "==", replace_reads(each.value, before)))
        reached[each.effect] = Assert(each.subject, each.property + NOW, after)
    text = " and ".join(post.text for post in skill.post if any(single_effect(one) in reached for one in post.effects))
    added = (Requirement(label="", condition=each, text=text, source=skill.source) for each in needed)
    more = (
        Parameter(name=name, direction="infer", type=ClassType(cls), source=skill.source)
        for name, cls in levels.items()
    )
    levelled = _level_conditions(skill, before, levelling)
    levelled = structs.replace(levelled, parameters=(*skill.parameters, *more), pre=(*levelled.pre, *added))
    return _level_results(levelled, reached, levelling, before)


def _level_conditions(one: DescribedT, known: Mapping[PropertyOf, Variable], levelling: Levelling) -> DescribedT:
    def changed(requirements: tuple[Requirement, ...]) -> tuple[Requirement, ...]:
        return tuple(structs.replace(each, condition=levelling.of(each.condition, known)) for each in requirements)

    return structs.replace(one, pre=changed(one.pre), hold=changed(one.hold))


def _choose_name(name: str, taken: Collection[str]) -> str:
    others = (f"{name} {number}" for number in count(2))
    return name if name not in taken else next(each for each in others if each not in taken)


class LevelledOutcome(Outcome, frozen=True, kw_only=True):
    """An outcome whose effects are levels; `possible` is under which condition it may come."""

    possible: Condition

    def find_possibility(self, senses: tuple[Condition, ...]) -> Condition:
        return self.possible


def _level_results(
    skill: Skill,
    reached: Mapping[Effect, SingleEffect],
    levelling: Levelling,
    before: Mapping[PropertyOf, Variable],
) -> Skill:
    def changed(effects: tuple[Effect, ...]) -> tuple[Effect, ...]:
        return tuple(change(each) for each in effects if not _is_idle(each, levelling.idle))

    def change(effect: Effect) -> Effect:
        if isinstance(effect, ForEach):
            single = reached.get(effect.effect, effect.effect)
            return structs.replace(effect, when=levelling.of(effect.when, {}), effect=single)
        return reached.get(effect, effect)

    def condition(of: Condition) -> Condition:
        return levelling.of(of, {})

    post = (structs.replace(e, condition=condition(e.condition), effects=changed(e.effects)) for e in skill.post)

    def end(of: Outcome) -> Outcome:
        return LevelledOutcome(
            label=of.label,
            condition=condition(of.condition),
            effects=changed(of.effects),
            likely=of.likely,
            text=of.text,
            source=of.source,
            possible=levelling.of(of.find_possibility(skill.senses), before),
        )

    return structs.replace(skill, post=tuple(post), outcomes=tuple(map(end, skill.outcomes)))


def _is_idle(effect: Effect, idle: frozenset[str]) -> bool:
    single = single_effect(effect)
    return isinstance(single, Adjust | Assign) and single.property in idle
