"""From a goal to a checked schedule that is over early: steps of different robots side by side."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from skillc_compiler.library.conditions import Condition
from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.planning.plan import GaveUp, Plan, Solved, Step, Unsolvable
from skillc_runtime.planning.planners import Planners
from skillc_runtime.planning.problem.initial_state import TooManyValues
from skillc_runtime.planning.problem.neighbourhood import AT_ONCE
from skillc_runtime.planning.problem.pose import Posed, pose_problem
from skillc_runtime.planning.schedule import Schedule, Scheduled, Scheduler
from skillc_runtime.planning.solve import DEADLINE_S, solve
from skillc_runtime.planning.validation import PlanError, compute_work_s, validate
from skillc_runtime.plans.least import TOLERANCE_S, at_least_s
from skillc_runtime.plans.rehearsal import rehearse
from skillc_runtime.plans.scheduling import scheduled
from skillc_runtime.world.state.world_state import WorldState

BY_LINKS = "each step begins when the part of the plan before it is over"
SHARE = 0.5
"""The plan with the least work gets this share of the time, one that is over earlier what is left."""
BOUND_S = 4.0
"""Finding out how long any plan takes may take as long as this."""

ScheduleResult: TypeAlias = Scheduled | Unsolvable | GaveUp


@dataclass(frozen=True, slots=True)
class Question:
    """What is asked for: the goal, in which world, with which skills but without some steps, by a monotonic time."""

    library: SkillLibrary
    state: WorldState
    goal: Condition
    without: tuple[Step, ...]
    end: float

    @property
    def left_s(self) -> float:
        """The time that is left, in seconds."""
        return max(self.end - time.monotonic(), 0.0)


def quickest(
    library: SkillLibrary,
    state: WorldState,
    goal: Condition,
    planners: Planners,
    deadline_s: float = DEADLINE_S,
    without: Sequence[Step] = (),
) -> ScheduleResult:
    """Return a plan with times from a version of the world to the goal; each was played in the world model first.

    The plan with the least work is scheduled; where that cannot be proven to be over first, the scheduler looks for a
    better one. Without it, or if it fails, the answer says so.
    """
    question = Question(library, state, goal, tuple(without), time.monotonic() + deadline_s)
    least = solve(library, state, goal, planners.for_work, SHARE * deadline_s, without)
    if isinstance(least, Unsolvable) or (isinstance(least, GaveUp) and not least.searched):
        return least
    if isinstance(least, Solved) and not least.plan.steps:
        return _over_at_once(least, question)
    try:
        posed = pose_problem(library, state, goal, without, AT_ONCE)
    except TooManyValues as why:
        return GaveUp(str(why))
    question = replace(question, library=posed.library)
    first = _by_links(least, question) if isinstance(least, Solved) else least
    if isinstance(first, Scheduled):
        seconds = min(BOUND_S, question.left_s)
        least_s = at_least_s(posed, first.schedule, planners.for_work[0], seconds)
        first = _rated(replace(first, left_out=posed.left_out, assumptions=posed.assumptions), least_s)
        if first.optimal == "proven":
            return first
    return _better(first, planners.for_makespan, posed, question)


def _by_links(solved: Solved, question: Question) -> Scheduled | GaveUp:
    try:
        schedule = scheduled(solved.plan, question.library, question.state)
        rehearse(schedule, question.library, question.state, question.goal)
    except PlanError as error:
        return GaveUp(f"{solved.planner} returned a plan that does not work: {error}")
    return Scheduled(schedule, solved.plan, "best found", solved.planner, BY_LINKS)


def _over_at_once(solved: Solved, question: Question) -> Scheduled:
    """Return the schedule of a plan without steps."""
    schedule = scheduled(solved.plan, question.library, question.state)
    return Scheduled(schedule, solved.plan, "proven", solved.planner, BY_LINKS)


def _better(
    first: Scheduled | GaveUp, scheduler: Scheduler | None, posed: Posed, question: Question
) -> Scheduled | GaveUp:
    """Return what the scheduler finds if that is over earlier than the first schedule, else that with a note."""
    if scheduler is None:
        return _noted(first, "a temporal planner may find a better one: pip install 'skillc[temporal]'")
    answer = scheduler.schedule(posed.problem, question.left_s)
    if isinstance(answer, GaveUp):
        return _noted(first, answer.why)
    try:
        plan, tight = _tightened(answer, question)
    except PlanError as error:
        return _noted(first, f"{scheduler.name} returned a schedule that does not work: {error}")
    if isinstance(first, Scheduled) and tight.makespan_s >= first.schedule.makespan_s - TOLERANCE_S:
        return _noted(first, f"{scheduler.name} found none that is over earlier")
    least_s = first.at_least_s if isinstance(first, Scheduled) else None
    found = Scheduled(tight, plan, "best found", scheduler.name, scheduler.name)
    found = replace(found, left_out=posed.left_out, assumptions=posed.assumptions)
    return _rated(found, least_s or 0.0)


def _noted(answer: Scheduled | GaveUp, note: str) -> Scheduled | GaveUp:
    if isinstance(answer, GaveUp):
        return GaveUp(f"{answer.why}; {note}")
    return replace(answer, note=note)


def _tightened(schedule: Schedule, question: Question) -> tuple[Plan, Schedule]:
    """Return the steps in an order that works one after the other, and with the earliest times that it allows.

    A temporal planner leaves gaps between steps, and times that meet in other ways than steps that run can.
    """
    library, state, goal = question.library, question.state, question.goal
    by_begin = tuple(each.step for each in schedule.steps)
    by_end = tuple(each.step for each in sorted(schedule.steps, key=lambda each: each.end_s))
    try:
        validate(Plan(by_begin, 0.0), library, state, goal)
        steps = by_begin
    except PlanError:
        validate(Plan(by_end, 0.0), library, state, goal)
        steps = by_end
    plan = Plan(steps, compute_work_s(Plan(steps, 0.0), library, state))
    tight = scheduled(plan, library, state)
    rehearse(tight, library, state, goal)
    return plan, tight


def _rated(answer: Scheduled, least_s: float) -> Scheduled:
    if answer.schedule.makespan_s <= least_s + TOLERANCE_S:
        return replace(answer, optimal="proven")
    return replace(answer, at_least_s=least_s or None)
