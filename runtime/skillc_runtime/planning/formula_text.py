"""Formats formulas of a planning problem for people: objects and terms by short names, variables by parameters."""

from __future__ import annotations

from collections.abc import Mapping
from typing import assert_never

from skillc_model.format_condition import (
    format_all,
    format_any,
    format_class,
    format_condition,
    format_property,
    format_quantified,
    format_relation,
)
from skillc_model.levels import NOW
from skillc_model.pddl.domain import (
    ROOT,
    ClassMeaning,
    ExclusionMeaning,
    GoalMeaning,
    GuardMeaning,
    MovedMeaning,
    PropertyMeaning,
    RelationMeaning,
)
from skillc_model.pddl.formulas import Atom, Conjunction, Disjunction, Equal, Existential, Formula, Negation, Universal
from skillc_model.pddl.problem import Problem
from skillc_model.skills import SkillLibrary
from skillc_runtime.world.state.values import show


class FormulaFormatter:
    """Formats formulas, types and objects of one problem with the names of a library."""

    def __init__(self, problem: Problem, library: SkillLibrary) -> None:
        self._problem = problem
        self._short = library.vocabulary.short
        self._vocabulary = library.vocabulary
        self._texts = {
            (each.skill, part.condition): part.text
            for each in library.implementations.values()
            for part in (*each.pre, *each.hold)
        }
        self._classes = {each.name: each.cls for each in problem.domain.types}

    def format_type(self, name: str) -> str:
        """Return the short name of a type's class."""
        return "thing" if name == ROOT else self._short(self._classes[name])

    def format_object(self, name: str) -> str:
        """Return the short name of an object's individual."""
        return self._short(self._problem.names[name])

    def format(self, formula: Formula, names: Mapping[str, str] | None = None) -> str:
        """Return a formula as text; `names` maps its variables to the names to show."""
        shown = names or {}
        match formula:
            case Atom():
                return self._format_atom(formula, shown)
            case Equal(left, right):
                return f"{self._format_term(left, shown)} == {self._format_term(right, shown)}"
            case Negation(body):
                return f"not {self.format(body, shown)}"
            case Conjunction(parts):
                return format_all(self.format(part, shown) for part in parts)
            case Disjunction(parts):
                return format_any(self.format(part, shown) for part in parts)
            case Existential(variable, body):
                return self._format_quantified("exists", variable.name, variable.type, body, shown)
            case Universal(variable, body):
                return self._format_quantified("forall", variable.name, variable.type, body, shown)
            case _:
                assert_never(formula)

    def _format_quantified(self, word: str, variable: str, type_: str, body: Formula, names: Mapping[str, str]) -> str:
        return format_quantified(word, variable.removeprefix("?"), self.format_type(type_), self.format(body, names))

    def _format_atom(self, atom: Atom, names: Mapping[str, str]) -> str:
        terms = [self._format_term(term, names) for term in atom.terms]
        meaning = self._problem.domain.predicate[atom.predicate].meaning
        match meaning:
            case RelationMeaning(relation) if relation.endswith(NOW) and atom.terms[1] in self._problem.names:
                number = relation.removesuffix(NOW)
                value = self._problem.names[atom.terms[1]].removeprefix(f"{number}-")
                return format_property(terms[0], number, None if value == "none" else value)
            case RelationMeaning(relation):
                return format_relation(terms[0], relation, terms[1])
            case PropertyMeaning(property_, value):
                return format_property(terms[0], property_, show(value))
            case ClassMeaning(cls):
                return format_class(terms[0], self._short(cls))
            case GuardMeaning():
                text = self._texts.get((meaning.skill, meaning.condition))
                text = text or format_condition(meaning.condition, self._vocabulary)
                return f"{text} for {', '.join(terms)}"
            case GoalMeaning():
                return "the goal"
            case MovedMeaning():
                return f"{', '.join(terms)} moved"
            case ExclusionMeaning():
                return f"tried before with {', '.join(terms)}"
            case _:
                assert_never(meaning)

    def _format_term(self, term: str, names: Mapping[str, str]) -> str:
        if term in names or term not in self._problem.names:
            return names.get(term, term.removeprefix("?"))
        return self._short(self._problem.names[term])
