"""Reads plans that planners print: action and object names to skills and IRIs, costs from the problem."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

import msgspec

from skillc_model.levels import is_level_parameter
from skillc_model.pddl.domain import Action, ComputedCost, FixedCost
from skillc_model.pddl.problem import Problem
from skillc_runtime.planning.plan import Plan, Step


class PlanTextError(ValueError):
    """A text that is not a plan of the problem; the message quotes it."""


class CostedPlan(msgspec.Struct, frozen=True):
    """A plan with its cost in the planner's units; `exact` if no duration was rounded down."""

    plan: Plan
    units: int
    exact: bool

    def at_least_s(self, problem: Problem) -> float:
        """Return a lower bound in s on the duration of any plan, provided that none costs fewer units."""
        return float(self.units / problem.domain.scale)


def cost_plan(problem: Problem, actions: Iterable[tuple[str, ...]]) -> CostedPlan:
    """Return the plan of actions given as (name, object ..); PlanTextError when there is no such action or object."""
    ground = [_find_action(problem, each) for each in actions]
    values = {(each.function, each.arguments): each.seconds for each in problem.costs}
    durations = [_duration_s(action, arguments, values) for action, arguments in ground]
    steps = (_make_step(problem, *each) for each in ground)
    plan = Plan(tuple(step for step in steps if step is not None), float(sum(durations)))
    units = sum(map(problem.domain.units, durations))
    return CostedPlan(plan, units, units == problem.domain.scale * sum(durations))


def read_step(problem: Problem, words: tuple[str, ...]) -> Step | None:
    """Return the step of an action (name, object ..); None for the auxiliary action that asserts the goal.

    PlanTextError when there is no such action or object.
    """
    return _make_step(problem, *_find_action(problem, words))


def _make_step(problem: Problem, action: Action, arguments: tuple[str, ...]) -> Step | None:
    if action.skill is None:
        return None
    named = dict(zip(action.binds, map(problem.names.__getitem__, arguments), strict=True))
    return Step(
        action.skill, {name: iri for name, iri in named.items() if not is_level_parameter(name)}, action.outcome
    )


def _find_action(problem: Problem, words: tuple[str, ...]) -> tuple[Action, tuple[str, ...]]:
    name, *arguments = words or ("",)
    action = problem.domain.action.get(name)
    known = all(each in problem.names for each in arguments)
    if action is None or not known or len(arguments) != len(action.parameters):
        raise PlanTextError(f"`{' '.join(words)}` is not an action of the problem")
    return action, tuple(arguments)


def _duration_s(
    action: Action, arguments: tuple[str, ...], values: dict[tuple[str, tuple[str, ...]], Fraction]
) -> Fraction:
    match action.cost:
        case FixedCost(seconds):
            return seconds
        case ComputedCost(function, variables):
            bound = {each.name: value for each, value in zip(action.parameters, arguments, strict=True)}
            return values[function, tuple(bound[each] for each in variables)]
