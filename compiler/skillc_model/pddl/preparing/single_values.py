"""Says of things that always have exactly one value that it is none of the others, where all things are asked.

`forall x: exists l: x at l and l allowed` has (allowed values) ** (things) cases; that no `x` is at a value that is not
allowed has one. It is the same if each thing has one value at first, and each step that takes it gives it another.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Set
from dataclasses import replace
from typing import assert_never

import msgspec
from msgspec import structs

from skillc_model.pddl.domain import Action, PlanningDomain
from skillc_model.pddl.formulas import (
    TRUE,
    Atom,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Universal,
    atoms,
    conjunction,
    conjuncts,
    disjunction,
)
from skillc_model.pddl.problem import Problem


def deny_other_values(problem: Problem) -> Problem:
    """Return an equivalent problem in which what is so for all things says which values these do not have."""
    domain = problem.domain
    single = {each.name for each in domain.predicates if each.changes and _has_one_value(each.name, problem)}
    if not single:
        return problem
    rewriting = _Rewriting(domain, single)
    types = {each.name: each.type for each in (*domain.constants, *problem.objects)}
    actions = tuple(rewriting.in_action(each, types) for each in domain.actions)
    goal = conjunction(rewriting.of_goal(each, problem) for each in conjuncts(problem.goal))
    return structs.replace(problem, domain=replace(domain, actions=actions), goal=goal)


def _has_one_value(name: str, problem: Problem) -> bool:
    """Whether each thing that a predicate of two arguments may be of has exactly one value, now and after each step."""
    parameters = problem.domain.predicate[name].parameters
    if len(parameters) != 2 or not all(_keeps_one(name, each) for each in problem.domain.actions):
        return False
    found = Counter(each.terms[0] for each in problem.init if each.predicate == name)
    return all(found[each] == 1 for each in problem.domain.of_type(problem.objects, parameters[0].type))


def _keeps_one(name: str, action: Action) -> bool:
    """Whether an action takes the one value of each thing to which it gives one."""
    given, taken = Counter[str](), Counter[str]()
    required = conjuncts(action.precondition)
    for change in action.effects:
        if change.atom.predicate != name:
            continue
        if change.variables or change.condition != TRUE or (not change.positive and change.atom not in required):
            return False
        (given if change.positive else taken)[change.atom.terms[0]] += 1
    return given == taken and all(number == 1 for number in given.values())


class _Rewriting(msgspec.Struct, frozen=True):
    """Rewrites formulas; `single` are the predicates of things that have exactly one value."""

    domain: PlanningDomain
    single: Set[str]

    def in_action(self, action: Action, types: Mapping[str, str]) -> Action:
        """Return the action with rewritten conditions."""
        here = {**types, **{each.name: each.type for each in action.parameters}}
        precondition, hold = self.of(action.precondition, here), self.of(action.hold, here)
        return structs.replace(action, precondition=precondition, hold=hold)

    def of_goal(self, part: Formula, problem: Problem) -> Formula:
        """Return a part of a goal, which is ground: one of some values is none of all others."""
        values = part.parts if isinstance(part, Disjunction) else ()
        of = {(each.predicate, each.terms[0]) for each in values if isinstance(each, Atom)}
        if len(of) != 1 or not all(isinstance(each, Atom) for each in values):
            return part
        ((name, thing),) = of
        members = [
            problem.domain.of_type(problem.objects, each.type) for each in self.domain.predicate[name].parameters
        ]
        if name not in self.single or thing not in members[0]:
            return part
        every = (Atom(name, (thing, each)) for each in members[1])
        return conjunction(Negation(each) for each in every if each not in values)

    def of(self, formula: Formula, types: Mapping[str, str], inside: bool = False) -> Formula:
        """Return the rewritten formula; `inside` a `forall`."""
        match formula:
            case Atom() | Equal() | Negation():
                return formula
            case Conjunction(parts):
                return conjunction(self.of(part, types, inside) for part in parts)
            case Disjunction(parts):
                return disjunction(self.of(part, types, inside) for part in parts)
            case Universal(variable, body):
                return Universal(variable, self.of(body, {**types, variable.name: variable.type}, True))
            case Existential(variable, body):
                here = {**types, variable.name: variable.type}
                value = self._value_of(formula, here) if inside else None
                if value is None:
                    return Existential(variable, self.of(body, here, inside))
                rest = conjunction(part for part in conjuncts(body) if part != value)
                return Universal(variable, disjunction((Negation(value), rest)))
            case _:
                assert_never(formula)

    def _value_of(self, formula: Existential, types: Mapping[str, str]) -> Atom | None:
        """Return the atom that a thing has the value, if nothing else of it changes; None if it is something else."""
        changing = [each for each in atoms(formula.body) if self.domain.predicate[each.predicate].changes]
        if len(changing) != 1 or changing[0] not in conjuncts(formula.body) or changing[0].predicate not in self.single:
            return None
        (value,) = changing
        thing, level = self.domain.predicate[value.predicate].parameters
        fits = self.domain.is_a(types[value.terms[0]], thing.type) and value.terms[1] == formula.variable.name
        return value if fits and self.domain.is_a(level.type, formula.variable.type) else None
