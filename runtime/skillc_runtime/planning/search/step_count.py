"""Tells whether a problem stays small when it is grounded, as far as its static facts tell."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import accumulate
from math import prod
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
from skillc_runtime.planning.search.bindings import Bindings
from skillc_runtime.planning.search.fact_index import FactIndex
from skillc_runtime.planning.typed_variables import list_typed_variables

_Members: TypeAlias = Mapping[str, Sequence[str]]
"""The objects of each type."""


def has_few_steps(problem: Problem, most: int) -> bool:
    """Return whether its ground actions have at most so many literals, of those that static facts allow."""
    return all(total <= most for total in accumulate(_list_sizes(problem)))


def _list_sizes(problem: Problem) -> Iterator[int]:
    """Yield the number of literals of each ground action that static facts allow."""
    domain = problem.domain
    changing = {each.atom.predicate for action in domain.actions for each in action.effects}
    members = {each.type: domain.of_type(problem.objects, each.type) for each in list_typed_variables(domain)}
    bindings = Bindings(FactIndex(each for each in problem.init if each.predicate not in changing), members)
    for action in domain.actions:
        condition = conjunction((action.precondition, action.hold))
        atoms = [each for each in conjuncts(condition) if isinstance(each, Atom) and each.predicate not in changing]
        size = _count_literals(condition, members) + _count_changes(action, members)
        for _ in bindings.extend(action, atoms, {}):
            yield size


def _count_changes(action: Action, members: _Members) -> int:
    """Return how many literals the effects of an action have once their variables are bound."""
    return sum(
        prod(len(members[each.type]) for each in change.variables) * (1 + _count_literals(change.condition, members))
        for change in action.effects
    )


def _count_literals(formula: Formula, members: _Members) -> int:
    """Return how many literals a formula has once its quantifiers are expanded."""
    match formula:
        case Atom() | Equal():
            return 1
        case Negation(body):
            return _count_literals(body, members)
        case Conjunction(parts) | Disjunction(parts):
            return sum(_count_literals(each, members) for each in parts)
        case Existential(variable, body) | Universal(variable, body):
            return len(members[variable.type]) * _count_literals(body, members)
        case _:
            assert_never(formula)
