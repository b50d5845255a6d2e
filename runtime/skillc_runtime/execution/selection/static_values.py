"""Evaluates the expressions of a body whose values are known before anything moves, and finds undefined ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import msgspec

from skillc_model.conditions import Condition, Expression, Invoke, PropertyOf
from skillc_model.read_write import is_fixed
from skillc_model.traversal import free_variables, walk
from skillc_runtime.execution.selection.python_targets import check_function
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.space.frame_tree import MissingFact
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.terms import ANGLES, BASE_FRAME_ID, ORIENTATION, POSITION
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

MEASURED_PROPERTIES = frozenset({BASE_FRAME_ID, *POSITION, *ORIENTATION, *ANGLES})
"""Skills write where things are without declaring it in their posts."""


class StaticValues(msgspec.Struct, frozen=True):
    """The values that are known, by name; `undefined` says why other names can never have a value."""

    values: dict[str, Value]
    undefined: dict[str, str]


def compute_static_values(
    expressions: Mapping[str, Expression], bound: Mapping[str, Value], state: WorldState, changing: frozenset[str]
) -> StaticValues:
    """Evaluate those expressions that have the same value at any later time.

    `bound` are the known values in scope, `changing` the relations and properties that skills change. An expression
    is undefined if a fact is missing that no skill supplies, or if its evaluation always fails.
    """
    known = StaticValues({}, {})
    for name, expression in expressions.items():
        problem = check_functions(expression, state)
        if problem is not None:
            known.undefined[name] = problem
            continue
        missing = next(_describe_missing_facts(expression, bound, state, changing), None)
        if missing is not None:
            known.undefined[name] = missing
        elif is_fixed(expression, changing, state.vocabulary) and bound.keys() >= free_variables(expression):
            try:
                known.values[name] = value_of(expression, state, bound)
            except EvaluationError as error:
                known.undefined[name] = str(error)
    return known


def check_functions(item: Condition | Expression, state: WorldState) -> str | None:
    """Return why one of the Python functions in an expression cannot be called, None if all can."""
    functions = state.vocabulary.functions
    calls = (part for part in walk(item) if isinstance(part, Invoke) and part.function in functions)
    problems = (check_function(functions[each.function].python, len(each.arguments)) for each in calls)
    return next((problem for problem in problems if problem is not None), None)


def _describe_missing_facts(
    expression: Expression, bound: Mapping[str, Value], state: WorldState, changing: frozenset[str]
) -> Iterator[str]:
    """Describe the facts that are missing for parts with known variables and that no skill supplies."""
    short = state.vocabulary.short
    for part in walk(expression):
        if isinstance(part, PropertyOf | Invoke) and bound.keys() >= free_variables(part):
            fact = _find_missing_fact(part, bound, state)
            if fact is not None and fact[1] not in changing | MEASURED_PROPERTIES:
                yield f"{short(fact[0])} has no {short(fact[1])} in the world model, and no skill supplies it"


def _find_missing_fact(
    part: PropertyOf | Invoke, bound: Mapping[str, Value], state: WorldState
) -> tuple[str, str] | None:
    """Return the individual and the property whose missing fact keeps a part from having a value now, or None."""
    try:
        value_of(part, state, bound)
    except EvaluationError as error:
        if isinstance(error.__cause__, MissingFact):
            return error.__cause__.individual, error.__cause__.property
        return _find_missing_property(part, bound, state)
    return None


def _find_missing_property(
    part: PropertyOf | Invoke, bound: Mapping[str, Value], state: WorldState
) -> tuple[str, str] | None:
    if not isinstance(part, PropertyOf) or state.vocabulary.is_computed(part.property):
        return None
    try:
        owner = value_of(part.of, state, bound)
    except EvaluationError:
        return None
    return (owner, part.property) if isinstance(owner, str) else None
