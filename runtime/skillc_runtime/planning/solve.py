"""From a goal to a checked plan: pose the problem, plan, run the plan in the world model, explain if there is none."""

from __future__ import annotations

import time
from collections.abc import Sequence

from skillc_compiler.library.conditions import Condition
from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.planning.choose import available
from skillc_runtime.planning.diagnose import why_unsolvable
from skillc_runtime.planning.plan import GaveUp, Plan, Planner, PlanResult, Solved, Step, Unsolvable
from skillc_runtime.planning.problem import Posed, pose_problem
from skillc_runtime.planning.validate import PlanError, validate
from skillc_runtime.world.conditions import evaluate
from skillc_runtime.world.state import WorldState

DEADLINE_S = 30.0


def solve(
    library: SkillLibrary,
    state: WorldState,
    goal: Condition,
    planners: Sequence[Planner] | None = None,
    deadline_s: float = DEADLINE_S,
    without: Sequence[Step] = (),
) -> PlanResult:
    """Return a plan from a version of the world to the goal; every plan was run in the world model first.

    `without` are steps that the plan may not have.
    Where a planner gives up, the next one gets the time that is left. GoalError when the goal cannot be planned for.
    """
    end = time.monotonic() + deadline_s
    posed = pose_problem(library, state, goal, without)
    if evaluate(goal, state, {}):
        return Solved(Plan((), 0.0), "proven", "the world as it is")
    failures: list[str] = []
    for planner in available() if planners is None else planners:
        result = _checked(planner.plan(posed.problem, max(end - time.monotonic(), 0.0)), posed, state, goal)
        match result:
            case Solved():
                return result
            case Unsolvable():
                return Unsolvable(why_unsolvable(posed, goal, state))
            case GaveUp(why):
                failures.append(why)
    return GaveUp("; ".join(failures))


def _checked(result: PlanResult, posed: Posed, state: WorldState, goal: Condition) -> PlanResult:
    if not isinstance(result, Solved):
        return result
    try:
        validate(result.plan, posed.library, state, goal)
    except PlanError as error:
        return GaveUp(f"{result.planner} returned a plan that does not work: {error}")
    return result
