"""Durative actions without quantifiers and disjunctions: all that aries takes.

A condition is written as cases, each an action of its own; what exists in a case becomes one more parameter.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count, product
from math import prod
from typing import TypeAlias, assert_never

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
from skillc_model.pddl.prepare import prepared
from skillc_model.pddl.problem import Problem
from skillc_model.pddl.text import used_up

MOST_CASES = 64

Literal: TypeAlias = Atom | Equal | Negation


class NotTemporal(ValueError):
    """A problem that aries cannot take; the message says what of it."""


@dataclass(frozen=True, slots=True)
class Disjunct:
    """One way for a formula to hold: all literals do, for some objects of the variables."""

    variables: tuple[Typed, ...] = ()
    literals: tuple[Literal, ...] = ()


@dataclass(frozen=True, slots=True)
class FlatAction:
    """An action with what must hold at its start and over all of it, and what changes at its start and at its end."""

    action: Action
    parameters: tuple[Typed, ...]
    start: tuple[Literal, ...]
    over_all: tuple[Literal, ...]
    at_start: tuple[Change, ...]
    at_end: tuple[Change, ...]


@dataclass(frozen=True, slots=True)
class FlatProblem:
    """A problem for aries, whose actions are ways to do those of `problem`."""

    problem: Problem
    actions: tuple[FlatAction, ...]
    goal: tuple[Literal, ...]


def flatten_problem(problem: Problem) -> FlatProblem:
    """Return a problem as aries takes it; NotTemporal when there is no such form of it."""
    plain = prepared(problem)
    actions = tuple(flat for action in plain.domain.actions for flat in _flat(action))
    (goal,) = _cases(plain.goal, count())
    return FlatProblem(plain, actions, goal.literals)


def _flat(action: Action) -> Iterator[FlatAction]:
    changes = tuple(_plain(change, action) for change in action.effects)
    at_start = tuple(each for each in changes if used_up(each, action))
    at_end = tuple(each for each in changes if not used_up(each, action))
    fresh = count()
    cases = _combined((_cases(action.precondition, fresh), _cases(action.hold, fresh)))
    for start, hold in cases:
        parameters = (*action.parameters, *start.variables, *hold.variables)
        yield FlatAction(action, parameters, (*start.literals, *hold.literals), hold.literals, at_start, at_end)


def _plain(change: Change, action: Action) -> Change:
    """Return a change without condition; a deletion needs none that there is something to delete."""
    of_itself = change.condition == TRUE or (not change.positive and change.condition == change.atom)
    if change.variables or not of_itself:
        raise NotTemporal(f"what {action.skill or 'the goal'} changes depends on what there is when it ends")
    return Change(change.atom, change.positive)


def _cases(formula: Formula, fresh: Iterator[int]) -> tuple[Disjunct, ...]:
    """Return the ways for a formula to hold; variables get names of their own."""
    match formula:
        case Atom() | Equal() | Negation():
            return (Disjunct(literals=(formula,)),)
        case Disjunction(parts):
            return tuple(case for part in parts for case in _cases(part, fresh))
        case Conjunction(parts):
            return tuple(map(_all, _combined([_cases(part, fresh) for part in parts])))
        case Existential(variable, body):
            return tuple(_exists(variable, case, next(fresh)) for case in _cases(body, fresh))
        case Universal():
            raise AssertionError(f"{formula} was to be written out")
        case _:
            assert_never(formula)


def _combined(ways: Sequence[tuple[Disjunct, ...]]) -> Iterator[tuple[Disjunct, ...]]:
    cases = prod(map(len, ways))
    if cases > MOST_CASES:
        raise NotTemporal(f"a condition has {cases} cases")
    return product(*ways)


def _all(cases: Sequence[Disjunct]) -> Disjunct:
    literals = dict.fromkeys(literal for case in cases for literal in case.literals)
    return Disjunct(tuple(variable for case in cases for variable in case.variables), tuple(literals))


def _exists(variable: Typed, case: Disjunct, number: int) -> Disjunct:
    own = Typed(f"{variable.name}_{number}", variable.type)
    literals = (_with(each, {variable.name: own.name}) for each in case.literals)
    return Disjunct((own, *case.variables), tuple(literals))


def _with(literal: Literal, names: Mapping[str, str]) -> Literal:
    match literal:
        case Atom(predicate, terms):
            return Atom(predicate, tuple(names.get(each, each) for each in terms))
        case Equal(left, right):
            return Equal(names.get(left, left), names.get(right, right))
        case Negation(body):
            inner = _with(body, names)
            assert not isinstance(inner, Negation)
            return Negation(inner)
        case _:
            assert_never(literal)
