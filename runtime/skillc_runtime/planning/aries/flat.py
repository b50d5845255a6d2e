"""Translates a problem to durative actions without quantifiers and disjunctions, the only ones that aries supports.

Each disjunct of a condition becomes an action of its own; an existential variable becomes one more parameter of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import count, product
from math import prod
from typing import TypeAlias, assert_never

import msgspec

from skillc_model.pddl.domain import Action
from skillc_model.pddl.formulas import (
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
)
from skillc_model.pddl.prepare import remove_axioms
from skillc_model.pddl.problem import Problem
from skillc_model.pddl.text import is_used_up

MAX_CASES = 64

Literal: TypeAlias = Atom | Equal | Negation


class NotTemporal(ValueError):
    """A problem that aries does not support; the message says what in it."""


class Disjunct(msgspec.Struct, frozen=True):
    """A disjunct of a formula: all its literals hold for some objects of its variables."""

    variables: tuple[Typed, ...] = ()
    literals: tuple[Literal, ...] = ()


class FlatAction(msgspec.Struct, frozen=True):
    """An action with its conditions at the start and over its whole duration, and its effects at the start and end."""

    action: Action
    parameters: tuple[Typed, ...]
    start: tuple[Literal, ...]
    over_all: tuple[Literal, ...]
    at_start: tuple[Change, ...]
    at_end: tuple[Change, ...]


class FlatProblem(msgspec.Struct, frozen=True):
    """A problem for aries; each of its actions is a variant of an action of `problem`."""

    problem: Problem
    actions: tuple[FlatAction, ...]
    goal: tuple[Literal, ...]


def flatten_problem(problem: Problem) -> FlatProblem:
    """Return a problem in the form that aries supports; NotTemporal if there is none."""
    plain = remove_axioms(problem)
    actions = tuple(flat for action in plain.domain.actions for flat in _flatten(action))
    (goal,) = _disjuncts(plain.goal, count())
    return FlatProblem(plain, actions, goal.literals)


def _flatten(action: Action) -> Iterator[FlatAction]:
    changes = tuple(_drop_condition(change, action) for change in action.effects)
    at_start = tuple(each for each in changes if is_used_up(each, action))
    at_end = tuple(each for each in changes if not is_used_up(each, action))
    fresh = count()
    cases = _combine((_disjuncts(action.precondition, fresh), _disjuncts(action.hold, fresh)))
    for start, hold in cases:
        parameters = (*action.parameters, *start.variables, *hold.variables)
        yield FlatAction(action, parameters, (*start.literals, *hold.literals), hold.literals, at_start, at_end)


def _drop_condition(change: Change, action: Action) -> Change:
    """Return a change without a condition; a deletion whose only condition is its own atom needs none."""
    unconditional = change.condition == TRUE or (not change.positive and change.condition == change.atom)
    if change.variables or not unconditional:
        raise NotTemporal(f"what {action.skill or 'the goal'} changes depends on the state in which it ends")
    return Change(change.atom, change.positive)


def _disjuncts(formula: Formula, fresh: Iterator[int]) -> tuple[Disjunct, ...]:
    """Return the disjuncts of a formula; their variables get unique names."""
    match formula:
        case Atom() | Equal() | Negation():
            return (Disjunct(literals=(formula,)),)
        case Disjunction(parts):
            return tuple(case for part in parts for case in _disjuncts(part, fresh))
        case Conjunction(parts):
            return tuple(map(_conjoin, _combine([_disjuncts(part, fresh) for part in parts])))
        case Existential(variable, body):
            return tuple(_bind_existential(variable, case, next(fresh)) for case in _disjuncts(body, fresh))
        case Universal():
            raise AssertionError(f"{formula} should have been expanded")
        case _:
            assert_never(formula)


def _combine(ways: Sequence[tuple[Disjunct, ...]]) -> Iterator[tuple[Disjunct, ...]]:
    cases = prod(map(len, ways))
    if cases > MAX_CASES:
        raise NotTemporal(f"a condition has {cases} cases")
    return product(*ways)


def _conjoin(cases: Sequence[Disjunct]) -> Disjunct:
    literals = dict.fromkeys(literal for case in cases for literal in case.literals)
    return Disjunct(tuple(variable for case in cases for variable in case.variables), tuple(literals))


def _bind_existential(variable: Typed, case: Disjunct, number: int) -> Disjunct:
    own = Typed(f"{variable.name}_{number}", variable.type)
    literals = (_rename(each, {variable.name: own.name}) for each in case.literals)
    return Disjunct((own, *case.variables), tuple(literals))


def _rename(literal: Literal, names: Mapping[str, str]) -> Literal:
    match literal:
        case Atom(predicate, terms):
            return Atom(predicate, tuple(names.get(each, each) for each in terms))
        case Equal(left, right):
            return Equal(names.get(left, left), names.get(right, right))
        case Negation(body):
            inner = _rename(body, names)
            assert not isinstance(inner, Negation)
            return Negation(inner)
        case _:
            assert_never(literal)
