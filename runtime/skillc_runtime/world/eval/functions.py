"""Makes functions that compute expressions, including calls of Python functions of the vocabulary."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import TypeAlias, assert_never

from skillc_model.conditions import (
    Aggregate,
    Arithmetic,
    Condition,
    Expression,
    Individual,
    Invoke,
    ListValue,
    Literal,
    Message,
    PropertyOf,
    Variable,
)
from skillc_model.format_type import format_type
from skillc_rdf.vocabulary.types import local_name
from skillc_runtime.motion.arrays import np
from skillc_runtime.world.eval.aggregates import compile_aggregate
from skillc_runtime.world.eval.bindings import Bindings, ConditionTest, ExpressionFunction, bound_value
from skillc_runtime.world.eval.messages import compile_message
from skillc_runtime.world.state.consistency.value_types import is_of_type
from skillc_runtime.world.state.properties import property_of, value_from_python
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import Value, show
from skillc_runtime.world.state.world_state import WorldState

CompileCondition: TypeAlias = Callable[[Condition], ConditionTest]


def make_function(expression: Expression, compile_condition: CompileCondition) -> ExpressionFunction:
    """Return a function that computes an expression; it returns None when a property it reads is missing.

    `compile_condition` makes the tests of the conditions in it.
    """

    def make(part: Expression) -> ExpressionFunction:
        return make_function(part, compile_condition)

    match expression:
        case Literal(value):
            return lambda state, bindings: value
        case Individual(iri):
            return lambda state, bindings: iri
        case Variable(name):
            return lambda state, bindings: bound_value(name, bindings)
        case PropertyOf(of, property_):
            return _property(make(of), property_)
        case Arithmetic(sign, left, right):
            return _arithmetic(sign, make(left), make(right))
        case Aggregate():
            return compile_aggregate(expression, compile_condition(expression.where), make(expression.value))
        case ListValue(items):
            return _list(tuple(make(item) for item in items))
        case Message(values=values):
            return compile_message(expression, {each.name: make(each.value) for each in values})
        case Invoke(function, arguments):
            return _invocation(function, tuple(make(argument) for argument in arguments))
        case _:
            assert_never(expression)


def _property(owner: ExpressionFunction, property_: str) -> ExpressionFunction:
    def read(state: WorldState, bindings: Bindings) -> Value | None:
        individual = owner(state, bindings)
        if individual is None:
            return None
        if not isinstance(individual, str):
            raise EvaluationError(f"{local_name(property_)} is asked of {individual!r}, which is not an individual")
        return property_of(state, individual, property_)

    return read


_OPERATORS: dict[str, Callable[..., Value]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}


def _arithmetic(sign: str, left: ExpressionFunction, right: ExpressionFunction) -> ExpressionFunction:
    apply = _OPERATORS[sign]

    def compute(state: WorldState, bindings: Bindings) -> Value | None:
        one, other = left(state, bindings), right(state, bindings)
        if one is None or other is None:
            return None
        if not isinstance(one, int | float | np.ndarray) or not isinstance(other, int | float | np.ndarray):
            raise EvaluationError(f"cannot compute {one!r} {sign} {other!r}")
        if sign == "/" and not np.all(other):
            raise EvaluationError(f"division of {one!r} by zero")
        return apply(one, other)

    return compute


def _list(items: tuple[ExpressionFunction, ...]) -> ExpressionFunction:
    def compute(state: WorldState, bindings: Bindings) -> Value | None:
        values = [value for item in items if (value := item(state, bindings)) is not None]
        return tuple(values) if len(values) == len(items) else None

    return compute


def _invocation(name: str, arguments: tuple[ExpressionFunction, ...]) -> ExpressionFunction:
    def compute(state: WorldState, bindings: Bindings) -> Value | None:
        values = []
        for argument in arguments:
            value = argument(state, bindings)
            if value is None:
                return None
            values.append(value)
        if name not in state.vocabulary.functions:
            raise EvaluationError(f"there is no function {name} in the vocabulary of this library")
        function = state.vocabulary.functions[name]
        result = value_from_python(function.python, name, state, *values)
        if result is None or is_of_type(result, function.result, state):
            return result
        declared = format_type(function.result, state.vocabulary)
        raise EvaluationError(f"{name} gives {show(result)}, where its declaration says `{declared}`")

    return compute
