"""Says what a person may change so that a goal can be reached: the facts that are missing, or that keep skills away."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from typing import assert_never

from skillc_model.chains import read_relation
from skillc_model.conditions import Holds, Individual, Not, PropertyOf
from skillc_model.format_condition import format_relation
from skillc_model.pddl.domain import (
    ClassMeaning,
    ExclusionMeaning,
    GoalMeaning,
    GuardMeaning,
    MovedMeaning,
    PropertyMeaning,
    RelationMeaning,
)
from skillc_model.pddl.problem import Problem
from skillc_model.read_write import terms_read, terms_written
from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.formula_text import FormulaFormatter
from skillc_runtime.planning.lacks import AtomReader, Lack, NearestChange, find_stated
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.obstacles import (
    RelationObstacle,
    find_missing_facts,
    find_missing_property,
    find_obstacle,
)
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.quantities import placeholder
from skillc_runtime.world.state.world_state import WorldState


class ChangeText:
    """Describes what is lacking in a problem; `obstacles` collects what reasoners say about it."""

    def __init__(self, problem: Problem, library: SkillLibrary, state: WorldState) -> None:
        self._problem, self._library, self._state = problem, library, state
        self._formatter = FormulaFormatter(problem, library)
        self._short = state.vocabulary.short
        self.obstacles: list[RelationObstacle] = []

    def describe(self, found: Sequence[NearestChange]) -> tuple[str, ...]:
        """Return the first of several changes, and the first ones of other kinds, which would do as well.

        Where another individual would do as well, its class is named.
        """
        alone = [each.lacking[0] for each in found if len(each.lacking) == 1]
        kinds: dict[frozenset[str], NearestChange] = {}
        for each in found:
            kinds.setdefault(frozenset(lack.atom.predicate for lack, _ in each.lacking), each)
        texts = dict.fromkeys(filter(None, (self._describe_change(each, alone) for each in kinds.values())))
        return tuple(f"or {text}" if number else text for number, text in enumerate(texts))

    def _describe_change(self, change: NearestChange, choices: Sequence[tuple[Lack, AtomReader]]) -> str:
        texts = (text for lack, reader in change.lacking for text in self._describe(lack, reader, choices))
        return "; ".join(dict.fromkeys(texts))

    def _describe(self, lack: Lack, reader: AtomReader, choices: Sequence[tuple[Lack, AtomReader]]) -> Iterator[str]:
        skill = reader.action.skill
        meaning = self._problem.domain.predicate[lack.atom.predicate].meaning
        if not lack.holds and not isinstance(meaning, GuardMeaning):
            yield f"`{self._formatter.format(lack.atom)}` holds, and {skill} does not start while it does"
            return
        match meaning:
            case GuardMeaning():
                yield from self._describe_guard(meaning, lack, skill)
                yield from self._describe_unused(terms_read(meaning.condition))
            case RelationMeaning(relation):
                yield self._describe_relation(relation, lack, reader, choices)
                yield from self._describe_unused({relation})
            case PropertyMeaning(property_):
                yield f"{skill} needs `{self._formatter.format(lack.atom)}`, which does not hold"
                yield from self._describe_unused({property_})
            case ClassMeaning(cls):
                owner = describe_class(lack.atom.terms[0], self._problem, self._state)
                yield f"{owner}, and {skill} needs a {self._short(cls)}"
            case GoalMeaning() | MovedMeaning() | ExclusionMeaning():
                return
            case _:
                assert_never(meaning)

    def _describe_relation(
        self, relation: str, lack: Lack, reader: AtomReader, choices: Sequence[tuple[Lack, AtomReader]]
    ) -> str:
        """Return a missing relation; with the classes of its sides if other individuals would do as well."""
        classes, skill = self._find_classes(lack, reader, choices), reader.action.skill
        shown = self._formatter.format(lack.atom, classes)
        if classes:
            return f"{skill} needs `{shown}`, and nothing in the scene fulfils that"
        subject, object_ = (self._problem.names[each] for each in lack.atom.terms)
        return self._describe_missing(shown, skill, subject, relation, object_)

    def _describe_missing(self, shown: str, skill: str | None, subject: str, relation: str, object_: str) -> str:
        """Return that a relation is missing, which is `shown` as text, and what to state so that it holds."""
        stated = find_stated(self._state, relation, subject, object_)
        fact = f"{self._short(subject)} {self._short(stated)} {self._short(object_)}" if stated else ""
        return f"{skill} needs `{shown}`, which does not hold" + (f": state `{fact}` if it is so" if fact else "")

    def _find_classes(
        self, lack: Lack, reader: AtomReader, choices: Sequence[tuple[Lack, AtomReader]]
    ) -> dict[str, str]:
        """Return the class for each term of an atom in place of which other choices have another individual."""
        alike = [
            each.atom.terms for each, other in choices if (other.action, other.atom) == (reader.action, reader.atom)
        ]
        return {
            term: f"a {self._formatter.format_type(type_)}"
            for side, (term, type_) in enumerate(zip(lack.atom.terms, reader.types, strict=True))
            if type_ is not None and len({each[side] for each in alike}) > 1
        }

    def _describe_guard(self, meaning: GuardMeaning, lack: Lack, skill: str | None) -> Iterator[str]:
        bindings = {
            variable: self._problem.names[term]
            for variable, term in zip(meaning.variables, lack.atom.terms, strict=True)
        }
        condition = meaning.condition if lack.holds else Not(meaning.condition)
        try:
            obstacle = find_obstacle(condition, self._state, bindings)
            if obstacle is not None:
                self.obstacles.append(obstacle)
                yield str(obstacle)
                return
            facts = find_missing_facts(condition, self._state, bindings)
            for each in facts:
                yield self._describe_missing_fact(each, skill)
            if facts:
                return
            missing = find_missing_property(condition, self._state, bindings)
            cure = "" if missing is None else self._describe_statement(missing)
            yield explain(condition, self._state, bindings, self._state.vocabulary) + cure
        except EvaluationError as reason:
            yield str(reason)

    def _describe_missing_fact(self, fact: Holds, skill: str | None) -> str:
        assert isinstance(fact.subject, Individual) and isinstance(fact.object, Individual)
        subject, relation, object_ = fact.subject.iri, read_relation(fact.relation), fact.object.iri
        shown = format_relation(self._short(subject), relation, self._short(object_))
        return self._describe_missing(shown, skill, subject, relation, object_)

    def _describe_statement(self, missing: PropertyOf) -> str:
        """Return what to state of a property that an individual lacks; empty if it is computed."""
        term = self._state.vocabulary.properties.get(missing.property)
        if term is None or term.computed_by is not None or not isinstance(missing.of, Individual):
            return ""
        return f": state `{self._short(missing.of.iri)} {self._short(term.iri)} {placeholder(term)}`"

    def _describe_unused(self, terms: Set[str]) -> Iterator[str]:
        return describe_unused_skills(terms, self._problem, self._library)


def describe_class(name: str, problem: Problem, state: WorldState) -> str:
    """Return the classes of an object as a sentence."""
    iri, short = problem.names[name], state.vocabulary.short
    return f"{short(iri)} is a {' and a '.join(sorted(map(short, state.types(iri))))}"


def describe_unused_skills(terms: Set[str], problem: Problem, library: SkillLibrary) -> Iterator[str]:
    """Yield the skills that are left out of planning, with the reasons, if they alone change one of these terms."""
    written = {name: terms_written(each.results, library.vocabulary) for name, each in library.skills.items()}
    planned = {each.skill for each in problem.domain.actions if each.skill is not None}
    wanted = terms - frozenset[str]().union(*(written[each] for each in planned))
    reasons = {each.skill: each.reason for each in problem.domain.excluded}
    left_out = {name: "it is `noplan`" for name, each in library.skills.items() if not each.planned} | reasons
    for name in sorted(each for each in left_out if not wanted.isdisjoint(written.get(each, ()))):
        yield f"{name}, which changes it, is left out of planning: {left_out[name]}"
