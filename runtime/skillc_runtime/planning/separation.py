"""Keeps steps of a plan apart that facts let run at the same time."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

from msgspec.structs import replace

from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.makespan.scheduling import schedule_plan
from skillc_runtime.planning.plan import Plan, Solved
from skillc_runtime.planning.schedule import Scheduled
from skillc_runtime.world.state.world_state import WorldState

AnswerT = TypeVar("AnswerT", bound=Solved | Scheduled)


def keep_apart(answer: AnswerT, pairs: Iterable[tuple[int, int]], library: SkillLibrary, state: WorldState) -> AnswerT:
    """Return an answer in which pairs of steps of the plan, by index, do not run at the same time.

    A schedule that takes longer by this is not proved optimal any more: some other plan may take as long as it took.
    """
    apart = frozenset(pairs)
    if not apart:
        return answer
    plan: Plan = replace(answer.plan, apart=apart)
    if not isinstance(answer, Scheduled):
        return replace(answer, plan=plan)
    before_s, schedule = answer.schedule.makespan_s, schedule_plan(plan, library, state)
    if schedule.makespan_s <= before_s:
        return replace(answer, plan=plan, schedule=schedule)
    least_s = before_s if answer.optimal == "proven" else answer.at_least_s
    return replace(answer, plan=plan, schedule=schedule, optimal="best found", at_least_s=least_s)
