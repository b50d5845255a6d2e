"""Evaluates expressions in a version of the world, and says what they lack."""

from __future__ import annotations

from typing import assert_never

from skillc_model.conditions import (
    Aggregate,
    And,
    Arithmetic,
    Expression,
    Individual,
    Invoke,
    ListValue,
    Literal,
    Message,
    PropertyOf,
    Variable,
)
from skillc_model.format_condition import format_condition
from skillc_model.rewriting import substitute
from skillc_rdf.vocabulary.types import NumberType, ValueType, Vocabulary
from skillc_runtime.world.eval.aggregates import compile_members
from skillc_runtime.world.eval.bindings import Bindings as Bindings
from skillc_runtime.world.eval.bindings import ExpressionFunction
from skillc_runtime.world.eval.bindings import bound_value as bound_value
from skillc_runtime.world.eval.bindings import iri_of as iri_of
from skillc_runtime.world.eval.conditions import compile_condition
from skillc_runtime.world.eval.functions import make_function
from skillc_runtime.world.eval.identity_cache import IdentityCache
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


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
        case Aggregate():
            return _describe_none(missing, state, bindings)
        case _:
            return f"{missing} has no value"


def _describe_none(aggregate: Aggregate, state: WorldState, bindings: Bindings) -> str:
    """Return that there is no individual of which a number could be taken."""
    known = {
        name: Individual(each) for name, each in bindings.items() if isinstance(each, str) and each in state.individuals
    }
    where = substitute(aggregate.where, known)
    such = "" if where == And(()) else f" of which `{format_condition(where, state.vocabulary)}` holds"
    return f"`{aggregate.function}` has no value: there is no {state.vocabulary.short(aggregate.cls)}{such}"


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
        case Message(values=values):
            lost = (each.value for each in values if compile_expression(each.value)(state, bindings) is None)
            return find_missing_value(next(lost), state, bindings)
        case Aggregate(where=where, value=value):
            members = compile_members(expression, compile_condition(where))(state, bindings)
            without = (scope for scope in members if compile_expression(value)(state, scope) is None)
            scope = next(without, None)
            return expression if scope is None else find_missing_value(value, state, scope)
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
        case Aggregate("sum" | "min" | "max" | "mean", value=value):
            return type_of(value, vocabulary)
        case Arithmetic() | Literal() | Variable() | Individual() | ListValue() | Aggregate() | Message():
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
    return make_function(expression, compile_condition)


_compiled = IdentityCache(compile_expression)
