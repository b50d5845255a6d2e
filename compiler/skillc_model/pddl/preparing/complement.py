"""Adds complement predicates to a problem, so that no condition negates an atom for every object of a type.

Fast Downward encodes the possible locations of an object as the values of one variable and expands the negation of
one value into a disjunction of the others: `forall c: not (in c gripper)` grows to locations ** crates. The
complement `not-in`, which the actions maintain, costs nothing.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product
from math import prod
from typing import TypeAlias, assert_never

import msgspec
from msgspec import structs

from skillc_model.pddl.domain import ROOT, Action, PlanningDomain, Predicate
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
    conjunction,
    disjunction,
)
from skillc_model.pddl.names import make_unique
from skillc_model.pddl.problem import Problem

Types: TypeAlias = Mapping[str, str]

MOST_ATOMS = 50_000
"""A predicate gets no complement if this would have more atoms than this."""


def add_complements(problem: Problem) -> Problem:
    """Return an equivalent problem with complements of the predicates that actions negate for all objects of a type."""
    for name, types in _find_denied(problem.domain).items():
        problem = _with_complement(problem, name, types)
    return problem


class _CannotFollow(Exception):
    """An action makes the predicate true by a conditional or quantified effect, which the complement cannot follow."""


def _with_complement(problem: Problem, name: str, types: Sequence[str]) -> Problem:
    domain = problem.domain
    declared = domain.predicate[name]
    own = make_unique(f"not-{name}", {*domain.names, *domain.predicate})
    parameters = tuple(Typed(each.name, type_) for each, type_ in zip(declared.parameters, types, strict=True))
    complement = _Complement(name, structs.replace(declared, name=own, parameters=parameters), domain)
    members = [domain.of_type(problem.objects, each) for each in types]
    if prod(map(len, members)) > MOST_ATOMS:
        return problem
    try:
        actions = tuple(complement.action(each) for each in domain.actions)
    except _CannotFollow:
        return problem
    true = {each.terms for each in problem.init if each.predicate == name}
    initial = tuple(Atom(own, terms) for terms in product(*members) if terms not in true)
    extended = replace(domain, actions=actions, predicates=(*domain.predicates, complement.predicate))
    objects = {each.name: each.type for each in (*domain.constants, *problem.objects)}
    denied = (each.terms for each in _denied(problem.goal, objects, inside=True) if each.predicate == name)
    covers = all(domain.is_a(*pair) for terms in denied for pair in zip(terms, types, strict=True))
    goal = complement.said(problem.goal, inside=True) if covers else problem.goal
    return structs.replace(problem, domain=extended, init=(*problem.init, *initial), goal=goal)


class _Complement(msgspec.Struct, frozen=True):
    """The complement of the predicate called `of`: true of the tuples of its types for which `of` is false."""

    of: str
    predicate: Predicate
    domain: PlanningDomain

    def action(self, action: Action) -> Action:
        """Return the action with the complement in its conditions and effects; _CannotFollow if not possible."""
        own = [
            each for change in action.effects if change.atom.predicate == self.of for each in self._own(change, action)
        ]
        return structs.replace(
            action,
            precondition=self.said(action.precondition),
            hold=self.said(action.hold),
            effects=tuple(sorted((*action.effects, *own), key=lambda each: not each.positive)),
        )

    def said(self, formula: Formula, inside: bool = False) -> Formula:
        """Return a condition that says the complement where it negates an atom for all objects of a type."""
        match formula:
            case Negation(Atom(predicate, terms)) if inside and predicate == self.of:
                return Atom(self.predicate.name, terms)
            case Atom() | Equal() | Negation():
                return formula
            case Conjunction(parts):
                return conjunction(self.said(part, inside) for part in parts)
            case Disjunction(parts):
                return disjunction(self.said(part, inside) for part in parts)
            case Existential(variable, body):
                return Existential(variable, self.said(body, inside))
            case Universal(variable, body):
                return Universal(variable, self.said(body, True))
            case _:
                assert_never(formula)

    def _own(self, change: Change, action: Action) -> Iterator[Change]:
        """Yield the change of the complement that corresponds to a change of the predicate."""
        types = _types(self.domain, action, change)
        wanted = [each.type for each in self.predicate.parameters]
        given = [types[term] for term in change.atom.terms]
        if not all(_meet(self.domain, *pair) for pair in zip(wanted, given, strict=True)):
            return
        if change.positive and (change.variables or change.condition != TRUE):
            raise _CannotFollow
        narrow = {
            term: type_
            for term, type_ in zip(change.atom.terms, wanted, strict=True)
            if not self.domain.is_a(types[term], type_)
        }
        variables = tuple(Typed(each.name, narrow.get(each.name, each.type)) for each in change.variables)
        condition = TRUE if change.condition == change.atom else change.condition
        if not change.positive:
            condition = conjunction((condition, *self._not_made_true(change, action)))
        if condition != FALSE:
            atom = Atom(self.predicate.name, change.atom.terms)
            yield Change(atom, not change.positive, variables, condition)

    def _not_made_true(self, change: Change, action: Action) -> Iterator[Formula]:
        """Yield the conditions that a deleted atom differs from each atom that the action adds (adding wins)."""
        for other in action.effects:
            if other.positive and other.atom.predicate == self.of:
                pairs = list(zip(change.atom.terms, other.atom.terms, strict=True))
                types = {**_types(self.domain, action, other), **_types(self.domain, action, change)}
                if all(_meet(self.domain, types[one], types[two]) for one, two in pairs):
                    yield disjunction(Negation(Equal(one, two)) for one, two in pairs if one != two)


def _find_denied(domain: PlanningDomain) -> dict[str, list[str]]:
    """Return the predicates that need a complement, each with the types of the complement's arguments.

    The types are wide enough to cover the parameters of every action that changes the predicate.
    """
    found: dict[str, list[str]] = {}
    for action in domain.actions:
        for atom in _denied(conjunction((action.precondition, action.hold)), _types(domain, action)):
            if domain.predicate[atom.predicate].changes:
                found[atom.predicate] = _join(domain, found.get(atom.predicate, atom.terms), atom.terms)
    changes = [(each, _types(domain, action)) for action in domain.actions for each in action.effects]
    while True:
        wider = dict(found)
        for change, types in changes:
            name = change.atom.predicate
            if name in wider:
                quantified = {each.name for each in change.variables}
                given = [
                    wide if term in quantified else types[term]
                    for term, wide in zip(change.atom.terms, wider[name], strict=True)
                ]
                if all(_meet(domain, *pair) for pair in zip(wider[name], given, strict=True)):
                    wider[name] = _join(domain, wider[name], given)
        if wider == found:
            return found
        found = wider


def _denied(formula: Formula, types: Types, inside: bool = False) -> Iterator[Atom]:
    """Yield the atoms that a formula negates for all objects of a type, with types in place of the terms."""
    match formula:
        case Negation(Atom(predicate, terms)) if inside:
            yield Atom(predicate, tuple(types[each] for each in terms))
        case Atom() | Equal() | Negation():
            pass
        case Conjunction(parts) | Disjunction(parts):
            for part in parts:
                yield from _denied(part, types, inside)
        case Existential(variable, body):
            yield from _denied(body, {**types, variable.name: variable.type}, inside)
        case Universal(variable, body):
            yield from _denied(body, {**types, variable.name: variable.type}, True)
        case _:
            assert_never(formula)


def _types(domain: PlanningDomain, action: Action, change: Change | None = None) -> Types:
    variables = change.variables if change is not None else ()
    return {each.name: each.type for each in (*domain.constants, *action.parameters, *variables)}


def _meet(domain: PlanningDomain, one: str, other: str) -> bool:
    """Whether an object may be of both types."""
    return domain.is_a(one, other) or domain.is_a(other, one)


def _join(domain: PlanningDomain, some: Sequence[str], others: Sequence[str]) -> list[str]:
    """Return for each pair of types their narrowest common supertype."""
    above = [each.name for each in sorted(domain.types, key=lambda each: -each.depth)]
    return [
        next((each for each in above if domain.is_a(one, each) and domain.is_a(other, each)), ROOT)
        for one, other in zip(some, others, strict=True)
    ]
