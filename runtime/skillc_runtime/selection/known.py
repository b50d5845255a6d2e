"""The values of expressions that are known before anything moves, and those that there will never be."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from skillc_compiler.library.conditions import Condition, Expression, Invoke, PropertyOf
from skillc_compiler.library.reading import free_variables, walk
from skillc_runtime.selection.python import function_problem
from skillc_runtime.selection.reads import has_fixed_value
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.space.frame_tree import MissingFact
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.terms import BASE_FRAME_ID, ORIENTATION, POSITION
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

MEASURED = frozenset({BASE_FRAME_ID, *POSITION, *ORIENTATION})
"""Skills write where things are without saying so in their posts."""


@dataclass(frozen=True, slots=True)
class Known:
    """Values by name as far as they are known; `never` says of names why they can never have a value."""

    values: dict[str, Value]
    never: dict[str, str]


def known_values(
    expressions: Mapping[str, Expression], bound: Mapping[str, Value], state: WorldState, changing: frozenset[str]
) -> Known:
    """Compute those expressions that have the same value at any later time.

    `bound` are the names in scope whose values are known, `changing` the relations and properties that skills change.
    An expression can never have a value when it lacks a fact that no skill supplies, or fails for good.
    """
    known = Known({}, {})
    for name, expression in expressions.items():
        broken = unusable(expression, state)
        if broken is not None:
            known.never[name] = broken
            continue
        lacking = next(_lacking(expression, bound, state, changing), None)
        if lacking is not None:
            known.never[name] = lacking
        elif has_fixed_value(expression, changing, state.vocabulary) and bound.keys() >= free_variables(expression):
            try:
                known.values[name] = value_of(expression, state, bound)
            except EvaluationError as error:
                known.never[name] = str(error)
    return known


def unusable(item: Condition | Expression, state: WorldState) -> str | None:
    """Return why a Python function that is named somewhere can never be called, None when all can."""
    functions = state.vocabulary.functions
    calls = (part for part in walk(item) if isinstance(part, Invoke) and part.function in functions)
    problems = (function_problem(functions[each.function].python, len(each.arguments)) for each in calls)
    return next((problem for problem in problems if problem is not None), None)


def _lacking(
    expression: Expression, bound: Mapping[str, Value], state: WorldState, changing: frozenset[str]
) -> Iterator[str]:
    """Yield the facts that parts of an expression lack and that no skill supplies; what is in scope decides alone."""
    short = state.vocabulary.short
    for part in walk(expression):
        if isinstance(part, PropertyOf | Invoke) and bound.keys() >= free_variables(part):
            fact = _missing_fact(part, bound, state)
            if fact is not None and fact[1] not in changing | MEASURED:
                yield f"{short(fact[0])} has no {short(fact[1])} in the world model, and no skill supplies it"


def _missing_fact(part: PropertyOf | Invoke, bound: Mapping[str, Value], state: WorldState) -> tuple[str, str] | None:
    """Return the individual and the property that keep a part from having a value now; None where it is not a fact."""
    try:
        value_of(part, state, bound)
    except EvaluationError as error:
        if isinstance(error.__cause__, MissingFact):
            return error.__cause__.individual, error.__cause__.property
        return _missing_property(part, bound, state)
    return None


def _missing_property(
    part: PropertyOf | Invoke, bound: Mapping[str, Value], state: WorldState
) -> tuple[str, str] | None:
    if not isinstance(part, PropertyOf) or state.vocabulary.properties[part.property].computed_by is not None:
        return None
    try:
        owner = value_of(part.of, state, bound)
    except EvaluationError:
        return None
    return (owner, part.property) if isinstance(owner, str) else None
