"""Encodes a problem for aries: as a Protocol Buffers message of `unified_planning.proto`, version 1.3."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import assert_never

from skillc_model.pddl.domain import ROOT, ComputedCost, Cost, FixedCost, PlanningDomain
from skillc_model.pddl.formulas import Atom, Change, Equal, Negation, Typed
from skillc_model.pddl.problem import Problem
from skillc_runtime.planning.aries.flat import FlatAction, FlatProblem, Literal

IDLE = "up_idle"
"""The fluent that no running action locks a device; no predicate has this name."""

_BOOL, _INT, _OPERATOR = "up:bool", "up:integer", "up:operator"
_CONSTANT, _PARAMETER, _FLUENT, _FUNCTION, _STATE_VARIABLE, _APPLICATION = 1, 2, 3, 4, 5, 6
_START, _END, _GLOBAL_START, _GLOBAL_END = 2, 3, 0, 1
_MINIMIZE_MAKESPAN = 2
_FEATURES = (0, 1, 9, 11, 17, 18, 23, 27, 63)
"""Actions in continuous time, negative conditions, equality, types, makespan, static integer durations."""


def action_name(index: int) -> str:
    """Return the name of the flat action with this index in the message."""
    return f"a{index}"


def encode_problem(flat: FlatProblem) -> bytes:
    """Return the problem as a message, with the makespan as the metric to minimise."""
    problem, types = flat.problem, {each.name: each.type for each in flat.problem.objects}
    return encode_message(
        encode_text(1, "domain"),
        encode_text(2, "task"),
        *(encode_nested(3, each) for each in _types(problem)),
        *(encode_nested(4, each) for each in _fluents(problem)),
        *(
            encode_nested(5, encode_message(encode_text(1, each.name), encode_text(2, each.type)))
            for each in problem.objects
        ),
        *(encode_nested(6, _action(index, each, types, problem.domain)) for index, each in enumerate(flat.actions)),
        *(encode_nested(7, each) for each in _initial(problem, types)),
        *(encode_nested(9, encode_message(encode_nested(1, _literal(each, types)))) for each in flat.goal),
        *(encode_number(10, each) for each in _FEATURES),
        encode_nested(11, encode_number(1, _MINIMIZE_MAKESPAN)),
    )


def _types(problem: Problem) -> Iterator[bytes]:
    yield encode_text(1, ROOT)
    yield from (encode_message(encode_text(1, each.name), encode_text(2, each.parent)) for each in problem.domain.types)


def _fluents(problem: Problem) -> Iterator[bytes]:
    yield _fluent(IDLE, _BOOL, (Typed("?device", ROOT),))
    yield from (_fluent(each.name, _BOOL, each.parameters) for each in problem.domain.predicates)
    yield from (_fluent(each.name, _INT, each.parameters) for each in problem.domain.costs)


def _fluent(name: str, kind: str, parameters: Iterable[Typed]) -> bytes:
    default = _truth(False) if kind == _BOOL else _integer(1)
    return encode_message(
        encode_text(1, name), encode_text(2, kind), *map(_parameter, parameters), encode_nested(4, default)
    )


def _parameter(parameter: Typed, field: int = 3) -> bytes:
    return encode_nested(field, encode_message(encode_text(1, parameter.name), encode_text(2, parameter.type)))


def _action(index: int, flat: FlatAction, objects: Mapping[str, str], domain: PlanningDomain) -> bytes:
    types = {**objects, **{each.name: each.type for each in flat.parameters}}
    seconds = _duration(flat.action.cost, types, domain)
    idle = tuple(_state(IDLE, (each,), types) for each in flat.action.uses)
    return encode_message(
        encode_text(1, action_name(index)),
        *(_parameter(each, 2) for each in flat.parameters),
        encode_nested(3, encode_nested(1, encode_message(encode_nested(2, seconds), encode_nested(4, seconds)))),
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
    """Return a condition at a time point, or over the open interval between two."""
    between = encode_number(1, 1) + encode_number(3, 1) if first != last else b""
    return encode_nested(
        4,
        encode_message(
            encode_nested(1, expression),
            encode_nested(2, between + encode_nested(2, _at(first)) + encode_nested(4, _at(last))),
        ),
    )


def _changed(change: Change, when: int, types: Mapping[str, str]) -> bytes:
    return _effect(_state(change.atom.predicate, change.atom.terms, types), change.positive, when)


def _effect(state: bytes, value: bool, when: int) -> bytes:
    effect = encode_message(encode_nested(2, state), encode_nested(3, _truth(value)), encode_nested(4, _truth(True)))
    return encode_nested(5, encode_message(encode_nested(1, effect), encode_nested(2, _at(when))))


def _at(when: int) -> bytes:
    """Return a time point, without delay."""
    return encode_message(encode_nested(1, encode_number(1, when)), encode_nested(2, encode_number(2, 1)))


def _initial(problem: Problem, types: Mapping[str, str]) -> Iterator[bytes]:
    for atom in problem.init:
        yield encode_message(
            encode_nested(1, _state(atom.predicate, atom.terms, types)), encode_nested(2, _truth(True))
        )
    for device in list_devices(problem):
        yield encode_message(encode_nested(1, _state(IDLE, (device,), types)), encode_nested(2, _truth(True)))
    for cost in problem.costs:
        yield encode_message(
            encode_nested(1, _state(cost.function, cost.arguments, types, _INT)),
            encode_nested(2, _integer(problem.domain.units(cost.seconds))),
        )


def list_devices(problem: Problem) -> tuple[str, ...]:
    """Return the objects that an action may lock as devices."""
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
    return encode_message(
        *(encode_nested(2, each) for each in parts), encode_text(3, _BOOL), encode_number(4, _APPLICATION)
    )


def _state(fluent: str, terms: Iterable[str], types: Mapping[str, str], kind: str = _BOOL) -> bytes:
    parts = (_symbol(fluent, kind, _FLUENT), *(_term(each, types) for each in terms))
    return encode_message(
        *(encode_nested(2, each) for each in parts), encode_text(3, kind), encode_number(4, _STATE_VARIABLE)
    )


def _term(term: str, types: Mapping[str, str]) -> bytes:
    return _symbol(term, types[term], _PARAMETER if term.startswith("?") else _CONSTANT)


def _symbol(symbol: str, kind: str, role: int) -> bytes:
    return encode_message(encode_nested(1, encode_text(1, symbol)), encode_text(3, kind), encode_number(4, role))


def _truth(value: bool) -> bytes:
    return encode_message(encode_nested(1, encode_number(4, value)), encode_text(3, _BOOL), encode_number(4, _CONSTANT))


def _integer(value: int) -> bytes:
    return encode_message(encode_nested(1, encode_number(2, value)), encode_text(3, _INT), encode_number(4, _CONSTANT))


_VARINT, _LENGTH_DELIMITED = 0, 2


def encode_message(*fields: bytes) -> bytes:
    """Return a message with the given fields."""
    return b"".join(fields)


def encode_number(field: int, value: int) -> bytes:
    """Return a field with a number >= 0, a truth value or a member of an enumeration."""
    return _varint(field << 3 | _VARINT) + _varint(value)


def encode_text(field: int, value: str) -> bytes:
    """Return a field with a string."""
    return encode_nested(field, value.encode())


def encode_nested(field: int, value: bytes) -> bytes:
    """Return a field with a message."""
    return _varint(field << 3 | _LENGTH_DELIMITED) + _varint(len(value)) + value


def _varint(value: int) -> bytes:
    """Return seven bits a byte, the lowest first; all bytes but the last have the highest bit set."""
    groups = [value & 0x7F]
    while value := value >> 7:
        groups.append(value & 0x7F)
    return bytes(group | 0x80 for group in groups[:-1]) + bytes(groups[-1:])
