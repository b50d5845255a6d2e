"""Computes numbers and lists of the individuals of a class of which a condition holds."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias, assert_never

from skillc_model.conditions import Aggregate, Exists
from skillc_runtime.world.eval.bindings import Bindings, ConditionTest, ExpressionFunction
from skillc_runtime.world.eval.quantifiers import candidates
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

FindMembers: TypeAlias = Callable[[WorldState, Bindings], Iterator[Bindings]]


def compile_aggregate(aggregate: Aggregate, where: ConditionTest, value: ExpressionFunction) -> ExpressionFunction:
    """Return a function that computes an aggregate.

    It returns None if an individual has no value, and for `min`, `max` and `mean` of no individual.
    """
    find_members = compile_members(aggregate, where)

    def compute(state: WorldState, bindings: Bindings) -> Value | None:
        found: list[tuple[str, Value]] = []
        for scope in find_members(state, bindings):
            read = value(state, scope)
            if read is None:
                return None
            found.append((str(scope[aggregate.variable]), read))
        if aggregate.function == "ordered":
            return tuple(individual for individual, _ in sorted(found, key=_rank))
        return _compute(aggregate, [_as_number(read) for _, read in found])

    return compute


def compile_members(aggregate: Aggregate, where: ConditionTest) -> FindMembers:
    """Return a function that yields the names in scope with each individual in turn, in the order of IRIs."""
    narrow = candidates(Exists(aggregate.variable, aggregate.cls, aggregate.where))

    def find(state: WorldState, bindings: Bindings) -> Iterator[Bindings]:
        for individual in sorted(narrow(state, bindings)):
            scope = {**bindings, aggregate.variable: individual}
            if state.is_a(individual, aggregate.cls) and where(state, scope):
                yield scope

    return find


def _compute(aggregate: Aggregate, values: list[int | float]) -> int | float | None:
    match aggregate.function:
        case "count":
            return len(values)
        case "sum":
            return sum(values)
        case "min":
            return min(values, default=None)
        case "max":
            return max(values, default=None)
        case "mean":
            return sum(values) / len(values) if values else None
        case "ordered":
            raise ValueError("a list is no number")
        case _:
            assert_never(aggregate.function)


def _as_number(value: Value) -> int | float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise EvaluationError(f"{value!r} is not a number")
    return value


def _rank(found: tuple[str, Value]) -> int | float | str:
    individual, value = found
    if not isinstance(value, int | float | str):
        raise EvaluationError(f"{individual} is ordered by {value!r}, which is neither a number nor a text")
    return value
