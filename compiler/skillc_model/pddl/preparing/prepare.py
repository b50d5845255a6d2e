"""Rewrites a problem for `astar(lmcut())`, which does not support axioms.

Fast Downward compiles `forall` over changing predicates in preconditions, and disjunctive goals, into axioms. So the
former are expanded over the problem's objects, and the latter become an action that costs nothing. Fast Downward also
takes each combination of the disjuncts of a condition as an operator of its own: where there are too many because facts
that never change stand in them (`forall o (o before ?x implies o done)`), the action is copied for each value of ?x.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import replace
from fractions import Fraction
from itertools import product
from math import prod
from typing import assert_never

import msgspec
from msgspec import structs

from skillc_model.pddl.domain import Action, FixedCost, GoalMeaning, PlanningDomain, Predicate
from skillc_model.pddl.formulas import (
    FALSE,
    TRUE,
    Atom,
    Change,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Typed,
    Universal,
    atoms,
    conjunction,
    conjuncts,
    disjunction,
    existential,
)
from skillc_model.pddl.names import make_unique
from skillc_model.pddl.preparing.cases import MOST_CASES, write_few_cases
from skillc_model.pddl.problem import Problem

MOST_COPIES = 2000
"""The most copies of an action for the values of its variables."""

GOAL_REACHED = "goal-reached"
REACH_GOAL = "reach-goal"


def remove_axioms(problem: Problem) -> Problem:
    """Return an equivalent problem without axioms; its goal action, if any, does not become a step of a plan."""
    expanded = structs.replace(problem, domain=_expanded_domain(problem))
    literals = all(isinstance(each, Atom | Negation) for each in conjuncts(problem.goal))
    return expanded if literals else _with_goal_action(expanded)


def _expanded_domain(problem: Problem) -> PlanningDomain:
    """Return the domain with every `forall` in a condition expanded over the objects, which become constants."""
    domain, expansion = problem.domain, _Expansion(problem.domain, problem.objects, frozenset(problem.init))
    names = set(domain.action)
    actions = tuple(each for action in domain.actions for each in _expand(action, expansion, names))
    if actions == domain.actions:
        return domain
    possible = tuple(each for each in actions if FALSE not in (each.precondition, each.hold))
    return replace(domain, actions=possible, constants=problem.objects)


def _expand(action: Action, expansion: _Expansion, names: set[str]) -> Iterator[Action]:
    """Yield the expanded action, or copies of it for the values of variables that leave fewer disjunctions."""
    expanded = expansion.apply(action, {})
    variables = expansion.find_open(conjunction((expanded.precondition, expanded.hold)))
    values = [expansion.members_of(each) for each in action.parameters if each.name in variables]
    if not values or prod(map(len, values)) > MOST_COPIES:
        yield structs.replace(expanded, precondition=write_few_cases(expanded.precondition))
        return
    bound = [each.name for each in action.parameters if each.name in variables]
    for objects in product(*values):
        copy = expansion.apply(action, dict(zip(bound, objects, strict=True)))
        if FALSE not in (copy.precondition, copy.hold):
            name = make_unique(action.name, names)
            names.add(name)
            here = (Equal(variable, each) for variable, each in zip(bound, objects, strict=True))
            precondition = conjunction((*here, write_few_cases(copy.precondition)))
            yield structs.replace(copy, name=name, precondition=precondition)


def _with_goal_action(problem: Problem) -> Problem:
    domain, reached = problem.domain, Atom(GOAL_REACHED, ())
    action = Action(
        name=REACH_GOAL,
        skill=None,
        parameters=(),
        binds=(),
        precondition=write_few_cases(problem.goal),
        hold=Conjunction(()),
        effects=(Change(reached, True),),
        cost=FixedCost(Fraction(0)),
    )
    extended = replace(
        domain,
        predicates=(*domain.predicates, Predicate(GOAL_REACHED, (), GoalMeaning(), True)),
        actions=(*domain.actions, action),
        constants=problem.objects,
    )
    return structs.replace(problem, domain=extended, goal=reached)


class _Expansion(msgspec.Struct, frozen=True):
    """Expands every `forall`; static atoms are replaced by their value in `facts` to keep the expansion small."""

    domain: PlanningDomain
    objects: Sequence[Typed]
    facts: Set[Atom]

    def apply(self, action: Action, values: Mapping[str, str]) -> Action:
        """Return the action with expanded conditions."""
        precondition, hold = self.of(action.precondition, values), self.of(action.hold, values)
        return structs.replace(action, precondition=precondition, hold=hold)

    def members_of(self, variable: Typed) -> tuple[str, ...]:
        """Return the objects that a variable may be."""
        return self.domain.of_type(self.objects, variable.type)

    def find_open(self, formula: Formula) -> frozenset[str]:
        """Return the variables of facts that never change in disjunctions, if these have more than MOST_CASES cases."""
        several = [each for each in conjuncts(formula) if isinstance(each, Disjunction)]
        open_ = [
            {term for atom in atoms(each) if not self.domain.predicate[atom.predicate].changes for term in atom.terms}
            for each in several
        ]
        cases = prod(len(each.parts) for each, terms in zip(several, open_, strict=True) if terms)
        return frozenset().union(*open_) if cases > MOST_CASES else frozenset()

    def of(self, formula: Formula, values: Mapping[str, str]) -> Formula:
        """Return the expanded formula with variables replaced by the objects in `values`."""
        match formula:
            case Atom(predicate=predicate, terms=terms):
                return self._settled(Atom(predicate, tuple(values.get(each, each) for each in terms)))
            case Equal(left=left, right=right):
                return _equal(values.get(left, left), values.get(right, right))
            case Negation(body=body):
                inner = self.of(body, values)
                if isinstance(inner, Atom | Equal):
                    return Negation(inner)
                return FALSE if inner == TRUE else TRUE
            case Conjunction(parts=parts):
                return conjunction(self.of(part, values) for part in parts)
            case Disjunction(parts=parts):
                return disjunction(self.of(part, values) for part in parts)
            case Existential(variable=variable, body=body):
                return existential(variable, self.of(body, values))
            case Universal(variable=variable, body=body):
                names = self.domain.of_type(self.objects, variable.type)
                return conjunction(self.of(body, {**values, variable.name: name}) for name in names)
            case _:
                assert_never(formula)

    def _settled(self, atom: Atom) -> Formula:
        if self.domain.predicate[atom.predicate].changes or any(each.startswith("?") for each in atom.terms):
            return atom
        return TRUE if atom in self.facts else FALSE


def _equal(left: str, right: str) -> Formula:
    if left == right:
        return TRUE
    return Equal(left, right) if "?" in (left[0], right[0]) else FALSE
