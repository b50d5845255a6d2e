"""Writes out relations that a library defines, for planners, which then need no axioms and can prove more.

A planner reads the condition instead of the relation, as far as skills change what the condition reads; what they do
not change is evaluated beforehand. A definition that leads back to itself is written out up to a number of times.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import NamedTuple, TypeAlias, TypeVar

from msgspec import structs

from skillc_model.conditions import (
    And,
    Anything,
    Condition,
    Effect,
    Exists,
    Expression,
    Forall,
    ForEach,
    Holds,
    IsA,
    Not,
    Or,
    Variable,
)
from skillc_model.read_write import may_change, terms_written
from skillc_model.rewriting import NEVER, substitute
from skillc_model.skills import Implementation, Requirement, Skill, SkillLibrary
from skillc_model.traversal import walk
from skillc_rdf.vocabulary.types import Definition, Vocabulary

UNKNOWN_SCENE = 2
"""How often a definition that leads back to itself is written out where no scene says how often it may matter."""

ChangeCondition: TypeAlias = Callable[[Condition], Condition]
DescribedT = TypeVar("DescribedT", Skill, Implementation)


class Expansion(NamedTuple):
    """Writes out definitions, by relation.

    `times` says how often at most those are written out that lead back to themselves; this is enough for those that are
    `exact`.
    """

    definitions: Mapping[str, Definition]
    times: Mapping[str, int]
    exact: frozenset[str]
    vocabulary: Vocabulary

    def of(self, condition: Condition) -> Condition:
        """Return a condition that holds only where this one does, and in which the definitions are written out.

        It may hold less often only because of what is written out less often than would be needed. Where that is
        negated, the relation is left as it is, and planners refuse it.
        """
        return self._expand(condition, {}, negated=False)

    def exactly(self, condition: Condition) -> Condition:
        """Return an equivalent condition; a definition that is not written out often enough is left as it is."""
        known = {iri: each for iri, each in self.definitions.items() if not each.group or iri in self.exact}
        return self._replace(definitions=known).of(condition)

    def _expand(self, condition: Condition, used: Mapping[tuple[str, ...], int], *, negated: bool) -> Condition:
        match condition:
            case Holds(relation=relation) if relation in self.definitions:
                return self._written_out(condition, used, negated=negated)
            case Not(body):
                return Not(self._expand(body, used, negated=not negated))
            case And(parts) | Or(parts):
                return type(condition)(tuple(self._expand(each, used, negated=negated) for each in parts))
            case Exists(body=body) | Forall(body=body):
                return structs.replace(condition, body=self._expand(body, used, negated=negated))
            case _:
                return condition

    def _written_out(self, asked: Holds, used: Mapping[tuple[str, ...], int], *, negated: bool) -> Condition:
        definition = self.definitions[asked.relation]
        group = definition.group
        if group:
            if negated and asked.relation not in self.exact:
                return asked
            if used.get(group, 0) >= self.times[asked.relation]:
                return NEVER
            used = {**used, group: used.get(group, 0) + 1}
        return self._expand(write_out(asked, self.vocabulary), used, negated=negated)


def write_out(asked: Holds, vocabulary: Vocabulary) -> Condition:
    """Return what a defined relation of two terms means: they are of its classes, and its condition holds of them."""
    definition = vocabulary.definitions[asked.relation]
    (signature,) = vocabulary.relations[asked.relation].signatures
    whole, guards, values = definition.condition, list[Condition](), dict[str, Expression]()
    for side, term, cls in (
        (definition.subject, asked.subject, signature.domain),
        (definition.object, asked.object, signature.range),
    ):
        if isinstance(term, Anything):
            whole = Exists(side.name, cls, whole)
        else:
            guards.append(IsA(term, cls))
            values[side.name] = term
    return And((*guards, substitute(whole, values)))


def find_changing(library: SkillLibrary) -> dict[str, Definition]:
    """Return the definitions that read what planned skills change, directly or by other definitions."""
    definitions, relations = library.vocabulary.definitions, library.vocabulary.relations
    if not definitions:
        return {}
    posts = (post for skill in library.skills.values() if skill.planned for post in skill.post)
    written = terms_written(posts, library.vocabulary)

    def changes(bases: Iterable[str]) -> bool:
        return any(may_change(each, written, library.vocabulary) for each in bases)

    return {
        iri: each
        for iri, each in definitions.items()
        if not relations[iri].computed_from or changes(relations[iri].computed_from)
    }


def expand_library(library: SkillLibrary, expansion: Expansion) -> SkillLibrary:
    """Return a library whose planned skills read the definitions instead of the relations."""
    return map_planned_conditions(library, expansion.of, expansion.exactly)


def map_planned_conditions(
    library: SkillLibrary, change: ChangeCondition, change_exactly: ChangeCondition | None = None
) -> SkillLibrary:
    """Return a library with other conditions of planned skills; `change_exactly` is for those of effects."""
    exactly = change_exactly or change
    skills = {name: _changed(each, change, exactly) if each.planned else each for name, each in library.skills.items()}
    implementations = {name: _changed(each, change, exactly) for name, each in library.implementations.items()}
    return structs.replace(library, skills=skills, implementations=implementations)


def expand_for_any_scene(library: SkillLibrary) -> SkillLibrary:
    """Return a library whose planned skills read no defined relation that changes."""
    changing = find_changing(library)
    if not changing:
        return library
    return expand_library(
        library, Expansion(changing, dict.fromkeys(changing, UNKNOWN_SCENE), frozenset(), library.vocabulary)
    )


def passes_on(definition: Definition, side: Variable) -> bool:
    """Whether a definition leads back to itself, and only to itself, with the same individual on a side."""
    is_subject = side == definition.subject
    again = (
        each for each in walk(definition.condition) if isinstance(each, Holds) and each.relation in definition.group
    )
    return len(definition.group) == 1 and all((each.subject if is_subject else each.object) == side for each in again)


def _changed(one: DescribedT, change: ChangeCondition, exactly: ChangeCondition) -> DescribedT:
    def changed(requirements: tuple[Requirement, ...]) -> tuple[Requirement, ...]:
        return tuple(structs.replace(each, condition=change(each.condition)) for each in requirements)

    def decided(effect: Effect) -> Effect:
        return structs.replace(effect, when=exactly(effect.when)) if isinstance(effect, ForEach) else effect

    post = tuple(structs.replace(each, effects=tuple(map(decided, each.effects))) for each in one.post)
    return structs.replace(one, pre=changed(one.pre), hold=changed(one.hold), post=post)
