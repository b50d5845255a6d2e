"""Evaluates expressions in a version of the world, including calls of Python functions of the vocabulary."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from typing import TypeAlias, assert_never

from skillc_model.conditions import (
    Anything,
    Arithmetic,
    Expression,
    Individual,
    Invoke,
    ListValue,
    Literal,
    PropertyOf,
    Term,
    Variable,
)
from skillc_model.format_type import format_type
from skillc_rdf.vocabulary.types import NumberType, ValueType, Vocabulary, local_name
from skillc_runtime.motion.arrays import np
from skillc_runtime.world.eval.identity_cache import IdentityCache
from skillc_runtime.world.state.consistency.value_types import is_of_type
from skillc_runtime.world.state.properties import property_of, value_from_python
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import Value, show
from skillc_runtime.world.state.world_state import WorldState

Bindings: TypeAlias = Mapping[str, "Value | None"]
"""Values by name in scope; an unset optional parameter is missing or None."""

ExpressionFunction: TypeAlias = Callable[[WorldState, Bindings], "Value | None"]


def value_of(expression: Expression, state: WorldState, bindings: Bindings) -> Value:
    """Return the value of an expression; EvaluationError when a property it reads is missing."""
    value = _compiled(expression)(state, bindings)
    if value is None:
        raise EvaluationError(f"{describe_missing_value(expression, state, bindings)} in the world model")
    return value


def describe_missing_value(expression: Expression, state: WorldState, bindings: Bindings) -> str:
    """Return which property is missing for the value of an expression."""
    missing, short = find_missing_value(expression, state, bindings), state.vocabulary.short
    match missing:
        case PropertyOf(Individual(owner), property_):
            return f"{short(owner)} has no {short(property_)}"
        case Invoke(function):
            return f"{function} gives no value"
        case _:
            return f"{missing} has no value"


def find_missing_value(expression: Expression, state: WorldState, bindings: Bindings) -> Expression:
    """Return the part of an expression without a value for which the whole has none; its owner is an individual."""
    match expression:
        case PropertyOf(of, property_):
            owner = compile_expression(of)(state, bindings)
            return (
                find_missing_value(of, state, bindings)
                if owner is None
                else PropertyOf(Individual(str(owner)), property_)
            )
        case Arithmetic(_, left, right):
            lacking = left if compile_expression(left)(state, bindings) is None else right
            return find_missing_value(lacking, state, bindings)
        case Invoke(_, arguments) | ListValue(arguments):
            lost = (each for each in arguments if compile_expression(each)(state, bindings) is None)
            first = next(lost, None)
            return expression if first is None else find_missing_value(first, state, bindings)
        case Literal() | Variable() | Individual():
            return expression
        case _:
            assert_never(expression)


def type_of(expression: Expression, vocabulary: Vocabulary) -> ValueType | None:
    """Return the type that the vocabulary gives the value of an expression; None if it is not known."""
    match expression:
        case PropertyOf(_, property_):
            term = vocabulary.properties.get(property_)
            return None if term is None else term.type
        case Invoke(function, _):
            return vocabulary.functions[function].result if function in vocabulary.functions else None
        case Arithmetic("+" | "-" as sign, left, right):
            return _type_of_sum(sign, type_of(left, vocabulary), type_of(right, vocabulary))
        case Arithmetic() | Literal() | Variable() | Individual() | ListValue():
            return None
        case _:
            assert_never(expression)


def _type_of_sum(sign: str, left: ValueType | None, right: ValueType | None) -> ValueType | None:
    """Return the type of a sum or difference; None if it is not known whether it is a temperature or a difference."""
    at, by = NumberType("Temperature"), NumberType("TemperatureDifference")
    if not {at, by} & {left, right}:
        return left or right
    if right == at:
        return at if sign == "+" else by
    if left == at and (sign == "+" or right == by):
        return at
    return by if left == right else None


def compile_expression(expression: Expression) -> ExpressionFunction:
    """Return a function that computes an expression; it returns None when a property it reads is missing."""
    match expression:
        case Literal(value):
            return lambda state, bindings: value
        case Individual(iri):
            return lambda state, bindings: iri
        case Variable(name):
            return lambda state, bindings: bound_value(name, bindings)
        case PropertyOf(of, property_):
            return _property(compile_expression(of), property_)
        case Arithmetic(sign, left, right):
            return _arithmetic(sign, compile_expression(left), compile_expression(right))
        case ListValue(items):
            return _list(tuple(compile_expression(item) for item in items))
        case Invoke(function, arguments):
            return _invocation(function, tuple(compile_expression(argument) for argument in arguments))
        case _:
            assert_never(expression)


_compiled = IdentityCache(compile_expression)


def bound_value(name: str, bindings: Bindings) -> Value:
    """Return the value of a name; EvaluationError for an optional parameter that was not passed."""
    value = bindings.get(name)
    if value is None:
        raise EvaluationError(f"`{name}` has no value: it was not passed (guard its use with `given {name}`)")
    return value


def iri_of(term: Term, bindings: Bindings) -> str | None:
    """Return the IRI of the individual that a term denotes; None when it is not bound."""
    match term:
        case Individual(iri):
            return iri
        case Variable(name):
            value = bindings.get(name)
            return value if isinstance(value, str) else None
        case Anything():
            return None
        case _:
            assert_never(term)


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
