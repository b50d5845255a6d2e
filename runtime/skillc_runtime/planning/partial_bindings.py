"""Binds the parameters of actions that cannot apply so that as few of their conditions as possible fail."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, islice
from typing import TypeAlias, assert_never

from skillc_model.pddl.domain import Action
from skillc_model.pddl.formulas import (
    Atom,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Universal,
    conjunction,
    conjuncts,
)
from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.search.grounding import Grounding

Values: TypeAlias = Mapping[str, str]

MAX_FAILED = 5
MAX_BINDINGS = 30
"""How many bindings with the same number of failed conditions are considered."""

MAX_TRIED = 3000
"""How many values are tried for the parameters of one action, in all."""


class PartialBindings:
    """Finds bindings in a problem; `grounding` is that of the problem, explored."""

    def __init__(self, problem: Problem, grounding: Grounding, limit: CancelToken) -> None:
        self._problem, self._grounding, self._limit = problem, grounding, limit
        self._types = {each.name: each.type for each in problem.objects}
        self._members: dict[str, tuple[str, ...]] = {}
        self._tried = 0

    def find(self, action: Action, start: Values) -> Iterator[tuple[dict[str, str], list[Formula]]]:
        """Yield bindings that extend `start`, with the conditions that fail: the fewest, and one more."""
        parts = conjuncts(conjunction((action.precondition, action.hold)))
        read = [(part, frozenset(_variables(part))) for part in parts]
        for most in range(MAX_FAILED):
            self._tried = 0
            found = tuple(islice(self._bind(action, read, dict(start), most), MAX_BINDINGS))
            if found:
                self._tried = 0
                yield from found
                yield from islice(self._bind(action, read, dict(start), most + 1), MAX_BINDINGS)
                return

    def mistyped(self, action: Action, values: Values) -> Iterator[tuple[str, str, str]]:
        """Yield the variables bound to an object of a class that the action does not take: with it, and the class."""
        wanted = {each.name: each.type for each in action.parameters}
        for variable, name in values.items():
            if not self._problem.domain.is_a(self._types[name], wanted[variable]):
                yield variable, name, wanted[variable]

    def _bind(
        self, action: Action, read: Sequence[tuple[Formula, frozenset[str]]], values: dict[str, str], most: int
    ) -> Iterator[tuple[dict[str, str], list[Formula]]]:
        self._limit.check()
        self._tried += 1
        if self._tried > MAX_TRIED:
            return
        open_ = {each.name: each.type for each in action.parameters if each.name not in values}
        known = [part for part, variables in read if variables.isdisjoint(open_)]
        failed = [part for part in known if not self._is_possible(part, values)]
        if len(failed) > most:
            return
        if not open_:
            yield values, failed
            return
        name, linked = self._choose(open_, read, values)
        members = self._members_of(open_[name])
        near = [each for each in members if each in linked]
        others = (each for each in members if each not in linked) if len(failed) < most or not near else ()
        for each in chain(near, others):
            yield from self._bind(action, read, {**values, name: each}, most)

    def _members_of(self, type_: str) -> tuple[str, ...]:
        if type_ not in self._members:
            self._members[type_] = self._problem.domain.of_type(self._problem.objects, type_)
        return self._members[type_]

    def _is_possible(self, part: Formula, values: Values) -> bool:
        return self._grounding.can_hold(part, values)

    def _choose(
        self, open_: Mapping[str, str], read: Sequence[tuple[Formula, frozenset[str]]], values: Values
    ) -> tuple[str, frozenset[str]]:
        """Return the parameter to bind next, and the values that an atom links with those that are bound."""
        best: tuple[str, frozenset[str]] | None = None
        for part, variables in read:
            left = variables & open_.keys()
            if isinstance(part, Atom) and len(left) == 1:
                name = min(left)
                linked = frozenset(self._grounding.find_partners(part, name, values))
                if linked and (best is None or len(linked) < len(best[1])):
                    best = name, linked
        return best or (min(open_), frozenset())


def unify(atom: Atom, wanted: Formula, action: Action) -> dict[str, str] | None:
    """Return the binding of an action's parameters with which an effect is the wanted atom; None if there is none."""
    if not isinstance(wanted, Atom) or atom.predicate != wanted.predicate:
        return None
    parameters = {each.name for each in action.parameters}
    values: dict[str, str] = {}
    for term, name in zip(atom.terms, wanted.terms, strict=True):
        if values.setdefault(term, name) != name or (term not in parameters and term != name):
            return None
    return {term: name for term, name in values.items() if term in parameters}


def _variables(formula: Formula) -> Iterator[str]:
    """Yield the variables of a formula that it does not bind."""
    match formula:
        case Atom(terms=terms):
            yield from (each for each in terms if each.startswith("?"))
        case Equal(left, right):
            yield from (each for each in (left, right) if each.startswith("?"))
        case Negation(body):
            yield from _variables(body)
        case Conjunction(parts) | Disjunction(parts):
            for part in parts:
                yield from _variables(part)
        case Existential(variable, body) | Universal(variable, body):
            yield from (each for each in _variables(body) if each != variable.name)
        case _:
            assert_never(formula)
