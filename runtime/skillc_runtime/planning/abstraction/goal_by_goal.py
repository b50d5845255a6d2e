"""Plans for one part of a goal after another, each in the part of the scene near it: a first plan of a large problem.

What breaks a part that was reached is planned again together with it. Nothing is proved.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

from skillc_model.conditions import And, Condition
from skillc_runtime.planning.plan import Plan, PlanResult, Solved, Step
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.world_state import WorldState

MOST_REPAIRS = 4
"""How often parts that a plan would break are added to what it has to reach."""

SolvePart: TypeAlias = Callable[[WorldState, Condition], PlanResult]
Follow: TypeAlias = Callable[[Plan, WorldState], WorldState]


def plan_goal_by_goal(
    parts: Sequence[Condition], state: WorldState, solve: SolvePart, follow: Follow
) -> tuple[Step, ...] | None:
    """Return the steps of a plan that reaches all parts of a goal; None if none was found in this way.

    solve: returns a plan from a world to a condition.
    follow: returns the world after a plan.
    """
    steps: list[Step] = []
    reached: list[Condition] = []
    for part in parts:
        found = None if evaluate(part, state, {}) else _reach(part, reached, state, solve, follow)
        if found is not None:
            plan, state = found
            steps += plan.steps
        elif not evaluate(part, state, {}):
            return None
        reached.append(part)
    return tuple(steps)


def _reach(
    part: Condition, reached: Sequence[Condition], state: WorldState, solve: SolvePart, follow: Follow
) -> tuple[Plan, WorldState] | None:
    """Return a plan for a part that ends with all that was reached before, and the world after it."""
    wanted = [part]
    for _ in range(MOST_REPAIRS):
        answer = solve(state, And(tuple(wanted)))
        if not isinstance(answer, Solved):
            return None
        after = follow(answer.plan, state)
        broken = [each for each in reached if not evaluate(each, after, {})]
        if not broken:
            return answer.plan, after
        wanted = [*broken, *(each for each in wanted if each not in broken)]
    return None
