"""A problem as a message of unified-planning, which aries reads: `unified_planning.proto` of that project, 1.3."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import assert_never

from skillc_compiler.library.pddl.domain import ROOT, ComputedCost, Cost, FixedCost, PlanningDomain
from skillc_compiler.library.pddl.formulas import Atom, Change, Equal, Negation, Typed
from skillc_compiler.library.pddl.problem import Problem
from skillc_runtime.planning.aries.flat import FlatAction, FlatProblem, Literal
from skillc_runtime.planning.aries.wire import message, nested, number, text

IDLE = "up_idle"
"""The fluent that says that nothing is running that locks the device; no predicate has this name."""

_BOOL, _INT, _OPERATOR = "up:bool", "up:integer", "up:operator"
_CONSTANT, _PARAMETER, _FLUENT, _FUNCTION, _STATE_VARIABLE, _APPLICATION = 1, 2, 3, 4, 5, 6
_START, _END, _GLOBAL_START, _GLOBAL_END = 2, 3, 0, 1
_MINIMIZE_MAKESPAN = 2
_FEATURES = (0, 1, 9, 11, 17, 18, 23, 27, 63)
"""Actions in continuous time, negative conditions, equality, types, makespan, static integer durations."""


def action_name(index: int) -> str:
    """Return the name under which aries knows the flat action of this index."""
    return f"a{index}"


def problem_message(flat: FlatProblem) -> bytes:
    """Return the problem as bytes: minimise the time at which all actions have ended."""
    problem, types = flat.problem, {each.name: each.type for each in flat.problem.objects}
    return message(
        text(1, "domain"),
        text(2, "task"),
        *(nested(3, each) for each in _types(problem)),
        *(nested(4, each) for each in _fluents(problem)),
        *(nested(5, message(text(1, each.name), text(2, each.type))) for each in problem.objects),
        *(nested(6, _action(index, each, types, problem.domain)) for index, each in enumerate(flat.actions)),
        *(nested(7, each) for each in _initial(problem, types)),
        *(nested(9, message(nested(1, _literal(each, types)))) for each in flat.goal),
        *(number(10, each) for each in _FEATURES),
        nested(11, number(1, _MINIMIZE_MAKESPAN)),
    )


def _types(problem: Problem) -> Iterator[bytes]:
    yield text(1, ROOT)
    yield from (message(text(1, each.name), text(2, each.parent)) for each in problem.domain.types)


def _fluents(problem: Problem) -> Iterator[bytes]:
    yield _fluent(IDLE, _BOOL, (Typed("?device", ROOT),))
    yield from (_fluent(each.name, _BOOL, each.parameters) for each in problem.domain.predicates)
    yield from (_fluent(each.name, _INT, each.parameters) for each in problem.domain.costs)


def _fluent(name: str, kind: str, parameters: Iterable[Typed]) -> bytes:
    default = _truth(False) if kind == _BOOL else _integer(1)
    return message(text(1, name), text(2, kind), *map(_parameter, parameters), nested(4, default))


def _parameter(parameter: Typed, field: int = 3) -> bytes:
    return nested(field, message(text(1, parameter.name), text(2, parameter.type)))


def _action(index: int, flat: FlatAction, objects: Mapping[str, str], domain: PlanningDomain) -> bytes:
    types = {**objects, **{each.name: each.type for each in flat.parameters}}
    seconds = _duration(flat.action.cost, types, domain)
    idle = tuple(_state(IDLE, (each,), types) for each in flat.action.uses)
    return message(
        text(1, action_name(index)),
        *(_parameter(each, 2) for each in flat.parameters),
        nested(3, nested(1, message(nested(2, seconds), nested(4, seconds)))),
        *(_condition(each, _START, _START) for each in idle),
        *(_condition(_literal(each, types), _START, _START) for each in flat.start),
        *(_condition(_literal(each, types), _START, _END) for each in flat.over_all),
        *(_effect(each, False, _START) for each in idle),
        *(_changed(each, _START, types) for each in flat.at_start),
        *(_changed(each, _END, types) for each in flat.at_end),
        *(_effect(each, True, _END) for each in idle),
    )


def _duration(cost: Cost, types: Mapping[str, str], domain: PlanningDomain) -> bytes:
    match cost:
        case FixedCost(seconds):
            return _integer(domain.units(seconds))
        case ComputedCost(function, arguments):
            return _state(function, arguments, types, _INT)
        case _:
            assert_never(cost)


def _condition(expression: bytes, first: int, last: int) -> bytes:
    """Return a condition at a point in time, or between two without them."""
    between = number(1, 1) + number(3, 1) if first != last else b""
    return nested(4, message(nested(1, expression), nested(2, between + nested(2, _at(first)) + nested(4, _at(last)))))


def _changed(change: Change, when: int, types: Mapping[str, str]) -> bytes:
    return _effect(_state(change.atom.predicate, change.atom.terms, types), change.positive, when)


def _effect(state: bytes, value: bool, when: int) -> bytes:
    effect = message(nested(2, state), nested(3, _truth(value)), nested(4, _truth(True)))
    return nested(5, message(nested(1, effect), nested(2, _at(when))))


def _at(when: int) -> bytes:
    """Return a point in time, without delay."""
    return message(nested(1, number(1, when)), nested(2, number(2, 1)))


def _initial(problem: Problem, types: Mapping[str, str]) -> Iterator[bytes]:
    for atom in problem.init:
        yield message(nested(1, _state(atom.predicate, atom.terms, types)), nested(2, _truth(True)))
    for device in devices(problem):
        yield message(nested(1, _state(IDLE, (device,), types)), nested(2, _truth(True)))
    for cost in problem.costs:
        yield message(
            nested(1, _state(cost.function, cost.arguments, types, _INT)),
            nested(2, _integer(problem.domain.units(cost.seconds))),
        )


def devices(problem: Problem) -> tuple[str, ...]:
    """Return the objects that some action may lock."""
    locks = {each.type for action in problem.domain.actions for each in action.parameters if each.name in action.uses}
    return tuple(each.name for each in problem.objects if any(problem.domain.is_a(each.type, lock) for lock in locks))


def _literal(literal: Literal, types: Mapping[str, str]) -> bytes:
    match literal:
        case Atom(predicate, terms):
            return _state(predicate, terms, types)
        case Equal(left, right):
            return _applied("up:equals", _term(left, types), _term(right, types))
        case Negation(body):
            return _applied("up:not", _literal(body, types))
        case _:
            assert_never(literal)


def _applied(operator: str, *arguments: bytes) -> bytes:
    parts = (_symbol(operator, _OPERATOR, _FUNCTION), *arguments)
    return message(*(nested(2, each) for each in parts), text(3, _BOOL), number(4, _APPLICATION))


def _state(fluent: str, terms: Iterable[str], types: Mapping[str, str], kind: str = _BOOL) -> bytes:
    parts = (_symbol(fluent, kind, _FLUENT), *(_term(each, types) for each in terms))
    return message(*(nested(2, each) for each in parts), text(3, kind), number(4, _STATE_VARIABLE))


def _term(term: str, types: Mapping[str, str]) -> bytes:
    return _symbol(term, types[term], _PARAMETER if term.startswith("?") else _CONSTANT)


def _symbol(symbol: str, kind: str, role: int) -> bytes:
    return message(nested(1, text(1, symbol)), text(3, kind), number(4, role))


def _truth(value: bool) -> bytes:
    return message(nested(1, number(4, value)), text(3, _BOOL), number(4, _CONSTANT))


def _integer(value: int) -> bytes:
    return message(nested(1, number(2, value)), text(3, _INT), number(4, _CONSTANT))
