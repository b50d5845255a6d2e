"""What is to hold always, as preconditions: planners that know nothing of it then keep it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import msgspec
from msgspec.structs import replace

from skillc_model.conditions import (
    And,
    Assert,
    Condition,
    Effect,
    Forall,
    Holds,
    Individual,
    Invoke,
    IsA,
    Not,
    Retract,
    Same,
    Term,
    Variable,
)
from skillc_model.format_condition import format_condition
from skillc_model.read_write import may_change, terms_read, terms_written_by
from skillc_model.skills import Requirement, Skill, SkillLibrary
from skillc_model.traversal import conjuncts, walk
from skillc_rdf.vocabulary.types import Vocabulary


class KeptLibrary(msgspec.Struct, frozen=True):
    """A library whose plans keep what is to hold always if it holds at first, and `at_end`, which their goal has too.

    `alone` if a step that changes what it reads runs beside no other step.
    """

    library: SkillLibrary
    at_end: tuple[Condition, ...] = ()
    alone: bool = False

    def goal(self, goal: Condition) -> Condition:
        """Return the goal of a plan that reaches `goal`."""
        return And((goal, *self.at_end)) if self.at_end else goal


def keep_always(library: SkillLibrary, always: Sequence[Condition]) -> KeptLibrary:
    """Return a library whose plans keep these conditions.

    Where they forbid facts that skills assert, a skill gets the precondition that it asserts none of them. Else each
    skill gets the conditions themselves, so that they hold before each step, and the goal gets them.
    """
    if not always:
        return KeptLibrary(library)
    parts = tuple(part for each in always for part in _split(each))
    needs = {name: _needs(skill, parts, library.vocabulary) for name, skill in library.skills.items()}
    if any(each is None for each in needs.values()):
        skills = {name: _with(skill, always, library) for name, skill in library.skills.items()}
        return KeptLibrary(replace(library, skills=skills), tuple(always), alone=True)
    skills = {name: _with(skill, needs[name] or (), library) for name, skill in library.skills.items()}
    return KeptLibrary(replace(library, skills=skills))


def _with(skill: Skill, conditions: Sequence[Condition], library: SkillLibrary) -> Skill:
    more = (
        Requirement(
            label=f"always_{number}",
            condition=each,
            text=f"always: {format_condition(each, library.vocabulary)}",
            source=skill.source,
        )
        for number, each in enumerate(conditions, 1)
    )
    return replace(skill, pre=(*skill.pre, *more)) if conditions else skill


class _Part(msgspec.Struct, frozen=True):
    """A condition for each individual of some classes, by variable."""

    classes: Mapping[str, str]
    condition: Condition


def _split(condition: Condition) -> Iterator[_Part]:
    for each in conjuncts(condition):
        if isinstance(each, Forall):
            yield from (_Part({each.variable: each.cls, **part.classes}, part.condition) for part in _split(each.body))
        else:
            yield _Part({}, each)


def _needs(skill: Skill, parts: Sequence[_Part], vocabulary: Vocabulary) -> tuple[Condition, ...] | None:
    """Return what has to hold before a skill so that it breaks no part; None if that is not known."""
    needs: list[Condition] = []
    for part in parts:
        for effect in (each for result in skill.results for each in result.effects):
            if not _touches(effect, part.condition, vocabulary):
                continue
            need = _need(effect, part, vocabulary)
            if need is None:
                return None
            needs.extend(need)
    return tuple(dict.fromkeys(needs))


def _touches(effect: Effect, condition: Condition, vocabulary: Vocabulary) -> bool:
    """Whether an effect may change the value of a condition."""
    terms = terms_read(condition)
    if any(isinstance(each, Invoke) for each in walk(condition)) or any(map(vocabulary.is_computed, terms)):
        return True
    if not terms.isdisjoint(vocabulary.definitions):
        return True
    return any(may_change(each, terms_written_by(effect, vocabulary), vocabulary) for each in terms)


def _need(effect: Effect, part: _Part, vocabulary: Vocabulary) -> tuple[Condition, ...] | None:
    """Return what has to hold before an effect so that a fact that never holds does not hold after it."""
    match part.condition:
        case Not(Holds(subject, relation, object_)) if relation not in vocabulary.closure.transitive:
            sources = vocabulary.closure.canonical_sources[relation]
        case _:
            return None
    match effect:
        case Retract():
            return ()
        case Assert(one, asserted, other) if len(sources) == 1:
            directed = vocabulary.closure.canonical(asserted)
            first, second = (one, other) if directed.flipped == sources[0].flipped else (other, one)
            pairs = ((subject, first), (object_, second))
            same = tuple(each for wanted, given in pairs for each in _match(wanted, given, part.classes))
            both = (Same(one, other),) if subject == object_ else ()
            return (Not(And((*same, *both))),) if directed.relation == sources[0].relation else None
        case _:
            return None


def _match(wanted: Term, given: Variable | Individual, classes: Mapping[str, str]) -> Iterator[Condition]:
    """Yield when an individual is one that a condition is about."""
    match wanted:
        case Variable(name) if name in classes:
            yield IsA(given, classes[name])
        case Variable() | Individual():
            yield Same(given, wanted)
        case _:
            return
