"""Whether a plan keeps the time that its task states."""

from __future__ import annotations

from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.makespan.lower_bound import TOLERANCE_S
from skillc_runtime.planning.makespan.scheduling import schedule_plan
from skillc_runtime.planning.plan import GaveUp, Solved, Unsolvable
from skillc_runtime.planning.schedule import PlanAnswer, Scheduled
from skillc_runtime.world.state.world_state import WorldState


def refuse_late(answer: PlanAnswer, within_s: float | None, library: SkillLibrary, state: WorldState) -> PlanAnswer:
    """Return an answer, or if its plan is expected to take longer than `within_s`, in s, that there is no such plan.

    That is proved only if the planner has proved how little time any plan takes. A policy takes its expected time.
    """
    if within_s is None or not isinstance(answer, Solved | Scheduled):
        return answer
    takes_s, at_least_s = _expect(answer, library, state)
    if takes_s <= within_s + TOLERANCE_S:
        return answer
    if at_least_s > within_s + TOLERANCE_S:
        return Unsolvable(f"the task has to be done within {within_s:g} s, and any plan takes {at_least_s:g} s or more")
    return GaveUp(f"the task has to be done within {within_s:g} s, and the plan that was found takes {takes_s:g} s")


def _expect(answer: Solved | Scheduled, library: SkillLibrary, state: WorldState) -> tuple[float, float]:
    """Return how long a plan is expected to take, and how long any plan takes at least, 0 if that is unknown, in s."""
    if isinstance(answer, Scheduled):
        makespan_s = answer.schedule.makespan_s
        return makespan_s, makespan_s if answer.optimal == "proven" else answer.at_least_s or 0.0
    plan = answer.plan
    return (plan.duration_s if plan.branches else schedule_plan(plan, library, state).makespan_s), 0.0
