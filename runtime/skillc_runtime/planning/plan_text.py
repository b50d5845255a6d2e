"""From the planner's words back to steps: names through the tables, costs from the problem."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

from skillc_model.pddl.domain import Action, ComputedCost, FixedCost
from skillc_model.pddl.problem import Problem
from skillc_runtime.planning.plan import Plan, Step


class PlanTextError(ValueError):
    """Something that is no plan of the problem; the message quotes it."""


def read_plan(problem: Problem, actions: Iterable[tuple[str, ...]]) -> Plan:
    """Return the plan of actions given as (name, object ..); PlanTextError when there is no such action or object."""
    return cost_plan(problem, actions).plan


@dataclass(frozen=True, slots=True)
class CostedPlan:
    """A plan with what planners take for its cost, in units, which is `exact` where no duration was rounded down."""

    plan: Plan
    units: int
    exact: bool

    def at_least_s(self, problem: Problem) -> float:
        """Return a time in seconds that every plan takes if none costs fewer units."""
        return float(self.units / problem.domain.scale)


def cost_plan(problem: Problem, actions: Iterable[tuple[str, ...]]) -> CostedPlan:
    """Return the plan of actions given as (name, object ..); PlanTextError when there is no such action or object."""
    ground = [_action(problem, each) for each in actions]
    values = {(each.function, each.arguments): each.seconds for each in problem.costs}
    durations = [_seconds(action, arguments, values) for action, arguments in ground]
    steps = (_step(problem, *each) for each in ground)
    plan = Plan(tuple(step for step in steps if step is not None), float(sum(durations)))
    units = sum(map(problem.domain.units, durations))
    return CostedPlan(plan, units, units == problem.domain.scale * sum(durations))


def read_step(problem: Problem, words: tuple[str, ...]) -> Step | None:
    """Return the step that an action (name, object ..) stands for, None for one that only says that the goal holds.

    PlanTextError when there is no such action or object.
    """
    return _step(problem, *_action(problem, words))


def _step(problem: Problem, action: Action, arguments: tuple[str, ...]) -> Step | None:
    if action.skill is None:
        return None
    return Step(action.skill, dict(zip(action.binds, map(problem.names.__getitem__, arguments), strict=True)))


def _action(problem: Problem, words: tuple[str, ...]) -> tuple[Action, tuple[str, ...]]:
    name, *arguments = words or ("",)
    action = problem.domain.action.get(name)
    known = all(each in problem.names for each in arguments)
    if action is None or not known or len(arguments) != len(action.parameters):
        raise PlanTextError(f"`{' '.join(words)}` is no action of the problem")
    return action, tuple(arguments)


def _seconds(
    action: Action, arguments: tuple[str, ...], values: dict[tuple[str, tuple[str, ...]], Fraction]
) -> Fraction:
    match action.cost:
        case FixedCost(seconds):
            return seconds
        case ComputedCost(function, variables):
            bound = {each.name: value for each, value in zip(action.parameters, arguments, strict=True)}
            return values[function, tuple(bound[each] for each in variables)]
