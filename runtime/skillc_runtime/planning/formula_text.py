"""Formulas of a problem in the author's words: individuals and terms by their names, variables by their parameters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import assert_never

from skillc_model.format_condition import (
    format_all,
    format_any,
    format_class,
    format_property,
    format_quantified,
    format_relation,
)
from skillc_model.pddl.domain import ROOT, ClassFact, GoalFact, GuardFact, PropertyFact, RelationFact
from skillc_model.pddl.formulas import Atom, Conjunction, Disjunction, Equal, Existential, Formula, Negation, Universal
from skillc_model.pddl.problem import Problem
from skillc_model.skills import Implementation, SkillLibrary
from skillc_runtime.world.state.values import show


class FormulaFormatter:
    """Writes formulas for people."""

    def __init__(self, problem: Problem, library: SkillLibrary) -> None:
        self._problem = problem
        self._short = library.vocabulary.short
        self._texts = {
            (each.skill, label): text for each in library.implementations.values() for label, text in _labelled(each)
        }
        self._classes = {each.name: each.cls for each in problem.domain.types}

    def type_(self, name: str) -> str:
        """Return what a type is called."""
        return "thing" if name == ROOT else self._short(self._classes[name])

    def object_(self, name: str) -> str:
        """Return what an object is called."""
        return self._short(self._problem.names[name])

    def formula(self, formula: Formula, names: Mapping[str, str] | None = None) -> str:
        """Return a formula; `names` says what its variables are called."""
        known = names or {}
        match formula:
            case Atom():
                return self._atom(formula, known)
            case Equal(left, right):
                return f"{self._term(left, known)} == {self._term(right, known)}"
            case Negation(body):
                return f"not {self.formula(body, known)}"
            case Conjunction(parts):
                return format_all(self.formula(part, known) for part in parts)
            case Disjunction(parts):
                return format_any(self.formula(part, known) for part in parts)
            case Existential(variable, body):
                return self._quantified("exists", variable.name, variable.type, body, known)
            case Universal(variable, body):
                return self._quantified("forall", variable.name, variable.type, body, known)
            case _:
                assert_never(formula)

    def _quantified(self, word: str, variable: str, type_: str, body: Formula, names: Mapping[str, str]) -> str:
        return format_quantified(word, variable.removeprefix("?"), self.type_(type_), self.formula(body, names))

    def _atom(self, atom: Atom, names: Mapping[str, str]) -> str:
        terms = [self._term(term, names) for term in atom.terms]
        meaning = self._problem.domain.predicate[atom.predicate].meaning
        match meaning:
            case RelationFact(relation):
                return format_relation(terms[0], relation, terms[1])
            case PropertyFact(property_, value):
                return format_property(terms[0], property_, show(value))
            case ClassFact(cls):
                return format_class(terms[0], self._short(cls))
            case GuardFact():
                text = self._texts.get((meaning.skill, meaning.label), meaning.label)
                return f"{text} for {', '.join(terms)}"
            case GoalFact():
                return "the goal"
            case _:
                assert_never(meaning)

    def _term(self, term: str, names: Mapping[str, str]) -> str:
        if term in self._problem.names:
            return self._short(self._problem.names[term])
        return names.get(term, term.removeprefix("?"))


def _labelled(implementation: Implementation) -> Iterator[tuple[str, str]]:
    yield from ((each.label, each.text) for each in (*implementation.pre, *implementation.hold))
