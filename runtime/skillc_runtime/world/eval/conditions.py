"""Evaluates conditions in one immutable version of the world: closed world, two-valued."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import assert_never

from skillc_model.conditions import (
    And,
    Anything,
    Compare,
    Condition,
    Exists,
    Expression,
    Forall,
    Given,
    HasProperty,
    Holds,
    Individual,
    IsA,
    Not,
    Or,
    PropertyOf,
    Same,
    Term,
    Variable,
)
from skillc_model.rounding import is_same
from skillc_runtime.world.eval.bindings import Bindings, bound_value
from skillc_runtime.world.eval.functions import make_function
from skillc_runtime.world.eval.identity_cache import IdentityCache
from skillc_runtime.world.eval.quantifiers import compile_quantified
from skillc_runtime.world.eval.scope import ConditionTest
from skillc_runtime.world.state.properties import property_of
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import Value, are_equal
from skillc_runtime.world.state.world_state import WorldState


def evaluate(condition: Condition, state: WorldState, bindings: Bindings) -> bool:
    """Whether a condition holds; EvaluationError when it cannot be decided (an unset name, a failing function)."""
    return _compiled(condition)(state, bindings)


def compile_condition(condition: Condition) -> ConditionTest:
    """Return the test for a condition; keep it where the condition is evaluated often."""
    match condition:
        case Holds(subject, relation, object_):
            return _holds(subject, relation, object_)
        case Compare(left, sign, right):
            return _compare(left, sign, right)
        case Same(left, right):
            one, other = _individual(left), _individual(right)
            return lambda state, bindings: one(bindings) == other(bindings)
        case HasProperty(subject, property_):
            owner = _individual(subject)
            return lambda state, bindings: property_of(state, owner(bindings), property_) not in (None, ())
        case IsA(subject, cls):
            member = _individual(subject)
            return lambda state, bindings: state.is_a(member(bindings), cls)
        case Given(parameter):
            return lambda state, bindings: bindings.get(parameter) is not None
        case Not(body):
            inner = compile_condition(body)
            return lambda state, bindings: not inner(state, bindings)
        case And(parts):
            tests = tuple(compile_condition(part) for part in parts)
            return lambda state, bindings: all(test(state, bindings) for test in tests)
        case Or(parts):
            tests = tuple(compile_condition(part) for part in parts)
            return lambda state, bindings: any(test(state, bindings) for test in tests)
        case Exists() | Forall():
            return compile_quantified(condition, compile_condition)
        case _:
            assert_never(condition)


_compiled = IdentityCache(compile_condition)


def _individual(term: Term) -> Callable[[Bindings], str]:
    match term:
        case Individual(iri):
            return lambda bindings: iri
        case Variable(name):
            return lambda bindings: _bound_individual(name, bindings)
        case Anything():
            raise EvaluationError("`_` stands for an individual in a relation only")
        case _:
            assert_never(term)


def _bound_individual(name: str, bindings: Bindings) -> str:
    value = bound_value(name, bindings)
    if type(value) is not str:
        raise EvaluationError(f"`{name}` is {value!r}, which is not an individual")
    return value


def _holds(subject: Term, relation: str, object_: Term) -> ConditionTest:
    match subject, object_:
        case Anything(), Anything():
            return lambda state, bindings: any(True for _ in state.pairs(relation))
        case Anything(), _:
            end = _individual(object_)
            return lambda state, bindings: bool(state.subjects(relation, end(bindings)))
        case _, Anything():
            start = _individual(subject)
            return lambda state, bindings: bool(state.objects(start(bindings), relation))
        case _:
            start, end = _individual(subject), _individual(object_)
            return lambda state, bindings: state.holds(start(bindings), relation, end(bindings))


def _are_same(one: Value, other: Value) -> bool:
    """Whether two values are equal: numbers but for rounding, as they may have been computed."""
    if isinstance(one, float | int) and isinstance(other, float | int) and bool not in (type(one), type(other)):
        return is_same(one, other)
    return are_equal(one, other)


_ORDER: dict[str, Callable[..., bool]] = {
    "==": _are_same,
    "!=": lambda one, other: not _are_same(one, other),
    "<": lambda one, other: operator.lt(one, other) and not _are_same(one, other),
    "<=": lambda one, other: operator.le(one, other) or _are_same(one, other),
    ">": lambda one, other: operator.gt(one, other) and not _are_same(one, other),
    ">=": lambda one, other: operator.ge(one, other) or _are_same(one, other),
}


def _compare(left: Expression, sign: str, right: Expression) -> ConditionTest:
    """Return the test for a comparison: false if a value is missing; of several values, one that compares is enough."""
    one, other = (make_function(side, compile_condition) for side in (left, right))
    compare = _ORDER[sign]
    several = isinstance(left, PropertyOf), isinstance(right, PropertyOf)

    def test(state: WorldState, bindings: Bindings) -> bool:
        a, b = one(state, bindings), other(state, bindings)
        if a is None or b is None:
            return False
        lefts = a if several[0] and isinstance(a, tuple) else (a,)
        rights = b if several[1] and isinstance(b, tuple) else (b,)
        try:
            return any(compare(x, y) for x in lefts for y in rights)
        except TypeError as error:
            raise EvaluationError(f"{a!r} and {b!r} cannot be compared by {sign}") from error

    return test
