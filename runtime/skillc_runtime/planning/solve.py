"""From a goal to a checked plan: pose the problem, plan, run the plan in the world model, explain if there is none."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace

from skillc_model.conditions import Condition
from skillc_model.pddl.problem import Problem
from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.abstraction.stages import PlanningStages, plan_in_stages
from skillc_runtime.planning.plan import (
    GaveUp,
    Optimal,
    Plan,
    Planner,
    PlanResult,
    Solved,
    Step,
    Unsolvable,
)
from skillc_runtime.planning.planners import list_planners
from skillc_runtime.planning.problem.neighbourhood import NARROW, AbstractionSize
from skillc_runtime.planning.problem.pose import GoalError, Posed, already_holds, pose_problem
from skillc_runtime.planning.unsolvability import explain_unsolvable
from skillc_runtime.planning.validation import PlanError, compute_work_s, validate
from skillc_runtime.world.state.world_state import WorldState

DEADLINE_S = 30.0


def solve(
    library: SkillLibrary,
    state: WorldState,
    goal: Condition,
    planners: Sequence[Planner] | None = None,
    deadline_s: float = DEADLINE_S,
    without: Sequence[Step] = (),
    *,
    prove: bool = False,
    breadth: AbstractionSize | None = NARROW,
) -> PlanResult:
    """Return a plan from a version of the world to the goal; every plan was run in the world model first.

    `without` are steps that the plan may not have. Of a large scene the part near the goal is planned with first, as
    wide as `breadth` says; with `prove` more of it is taken until the plan is proven to be the shortest.
    Where a planner gives up, the next one gets the time that is left. A goal that holds takes no steps, whatever
    planners can express; where one does not hold and cannot be planned for, nothing is searched.
    """
    end = time.monotonic() + deadline_s
    chosen = tuple(list_planners() if planners is None else planners)

    def pose(width: AbstractionSize | None) -> Posed:
        return pose_problem(library, state, goal, without, width)

    def answer(posed: Posed, seconds: float) -> PlanResult:
        return _answered(chosen, posed, state, goal, seconds)

    def search(problem: Problem, seconds: float) -> PlanResult:
        return chosen[0].plan(problem, seconds)

    def explain(posed: Posed) -> str:
        return explain_unsolvable(posed, goal, state)

    try:
        if already_holds(goal, state):
            return Solved(Plan((), 0.0), "proven", "the world as it is")
        return plan_in_stages(PlanningStages(pose, answer, search, explain), state, end, breadth, prove=prove)
    except GoalError as reason:
        return GaveUp(str(reason), searched=False)


def _answered(
    planners: Sequence[Planner], posed: Posed, state: WorldState, goal: Condition, deadline_s: float
) -> PlanResult:
    end = time.monotonic() + deadline_s
    failures: list[str] = []
    for planner in planners:
        result = _checked(planner.plan(posed.problem, max(end - time.monotonic(), 0.0)), posed, state, goal)
        match result:
            case Solved() | Unsolvable():
                return result
            case GaveUp(why):
                failures.append(why)
    return GaveUp("; ".join(failures))


def _checked(result: PlanResult, posed: Posed, state: WorldState, goal: Condition) -> PlanResult:
    if not isinstance(result, Solved):
        return result
    try:
        validate(result.plan, posed.library, state, goal)
        work_s = compute_work_s(result.plan, posed.library, state)
    except PlanError as error:
        return GaveUp(f"{result.planner} returned a plan that does not work: {error}")
    return _estimated(result, work_s, posed.assumptions) if posed.assumptions else _timed(result, work_s)


def _timed(solved: Solved, work_s: float) -> PlanResult:
    if work_s == solved.plan.duration_s:
        return solved
    return GaveUp(
        f"{solved.planner} returned a plan that does not work: it takes {work_s:g} s, not {solved.plan.duration_s:g}"
    )


def _estimated(solved: Solved, work_s: float, assumptions: tuple[str, ...]) -> Solved:
    """Return a plan without the claims that hold only as far as durations are what they were taken for."""
    optimal: Optimal = "best found" if solved.optimal == "best found" else "optimal for approximate durations"
    plan = replace(solved.plan, duration_s=work_s)
    return replace(solved, plan=plan, optimal=optimal, at_least_s=None, assumptions=assumptions)
