"""Plans for a goal with minimal makespan: steps of different robots run in parallel."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
from msgspec.structs import replace

from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_runtime.cancellation import Cancelled, CancelToken, cancelling
from skillc_runtime.planning.foresight import foresee
from skillc_runtime.planning.makespan.lower_bound import TOLERANCE_S, is_bound_unknown, makespan_lower_bound_s
from skillc_runtime.planning.makespan.scheduling import schedule_plan
from skillc_runtime.planning.makespan.simulation import simulate_schedule
from skillc_runtime.planning.plan import Excluded, GaveUp, Plan, Solved, Unsolvable
from skillc_runtime.planning.problem.chains import UnrolledProblem, unroll_chains
from skillc_runtime.planning.problem.initial_state import TooManyValues
from skillc_runtime.planning.problem.neighbourhood import AT_ONCE
from skillc_runtime.planning.problem.pose import PosedProblem
from skillc_runtime.planning.progress import ReportProgress, ignore_progress
from skillc_runtime.planning.schedule import DEADLINE_S, PlanAnswer, Planners, Schedule, Scheduled, Scheduler
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validation import PlanError, compute_work_s, validate
from skillc_runtime.world.state.world_state import WorldState

EARLIEST_START = "each step starts when those that it waits for have ended"
LEAST_WORK_SHARE = 0.2
"""The share of the time for the plan with the least work, if the rest is for one with a shorter makespan."""
LOWER_BOUND_SHARE = 0.1
"""The share of the time that is then left for a first lower bound of the makespan."""

MOST_INDIVIDUALS = 500
"""A scene with at most so many individuals that may be relevant is scheduled as a whole at first."""


class MakespanProblem(msgspec.Struct, frozen=True):
    """The goal, the world, the library, the steps that are excluded, what ends the search, and where it is reported."""

    library: SkillLibrary
    state: WorldState
    goal: Condition
    without: tuple[Excluded, ...]
    cancel: CancelToken
    report: ReportProgress


def minimise_makespan(
    library: SkillLibrary,
    state: WorldState,
    goal: Condition,
    planners: Planners,
    cancel: CancelToken | None = None,
    without: Sequence[Excluded] = (),
    report: ReportProgress = ignore_progress,
) -> PlanAnswer:
    """Return a plan with times from `state` to the goal, which was simulated in the world model; a policy without them.

    The plan with the least work is scheduled. If its makespan cannot be proven to be minimal, the scheduler searches
    for a shorter one; without a scheduler, or if it fails, the note of the answer has the reason.
    """
    cancel = cancel or CancelToken(DEADLINE_S)
    library, state = foresee(library, state, goal)
    problem = MakespanProblem(library, state, goal, tuple(without), cancel, report)
    first_part = cancel.share(LEAST_WORK_SHARE) if planners.for_makespan else cancel
    least_work = solve(library, state, goal, planners.for_work, first_part, without, report=report)
    if isinstance(least_work, Unsolvable) or (isinstance(least_work, GaveUp) and not least_work.searched):
        return least_work
    if isinstance(least_work, Solved) and least_work.plan.branches:
        return least_work  # when its steps run depends on what is sensed
    if isinstance(least_work, Solved) and not least_work.plan.steps:
        return _schedule_empty_plan(least_work, problem)
    try:
        with cancelling(cancel):
            unrolled = unroll_chains(library, state, goal)
            parts = _pose_parts(unrolled, without)
    except (TooManyValues, Cancelled) as why:
        return GaveUp(str(why))
    senses = any(each.outcome for each in parts[0].problem.domain.actions)
    if senses and isinstance(least_work, GaveUp):
        return least_work  # a scheduler would choose what comes of its steps
    problem = replace(problem, library=unrolled.whole)
    first = _schedule_least_work(least_work, problem) if isinstance(least_work, Solved) else least_work
    if isinstance(first, Scheduled):
        part = cancel.share(LOWER_BOUND_SHARE)
        posed = parts[0]
        lower_bound_s = makespan_lower_bound_s(posed, first.schedule, planners.for_work[0], part)
        first = _rate(replace(first, left_out=posed.left_out, assumptions=posed.assumptions), lower_bound_s)
        if first.optimal == "proven" or senses:
            return first
    for posed in parts:
        answer = _improve(first, planners.for_makespan, posed, problem)
        if cancel.reason is not None or (isinstance(answer, Scheduled) and answer.note is None):
            break
    return answer


def _pose_parts(unrolled: UnrolledProblem, without: Sequence[Excluded]) -> tuple[PosedProblem, ...]:
    """Return the problem for the whole scene unless it is large, and that for the part near the goal if it is not."""
    near = unrolled.pose(without, AT_ONCE)
    if not near.narrowed:
        return (near,)
    return (unrolled.pose(without), near) if near.candidate_count <= MOST_INDIVIDUALS else (near,)


def _schedule_least_work(solved: Solved, problem: MakespanProblem) -> Scheduled | GaveUp:
    try:
        schedule = schedule_plan(solved.plan, problem.library, problem.state)
        simulate_schedule(schedule, problem.library, problem.state, problem.goal)
    except PlanError as error:
        return GaveUp(f"{solved.planner} returned a plan that does not work: {error}")
    return Scheduled(schedule, solved.plan, "best found", solved.planner, EARLIEST_START)


def _schedule_empty_plan(solved: Solved, problem: MakespanProblem) -> Scheduled:
    """Return the schedule of a plan without steps."""
    schedule = schedule_plan(solved.plan, problem.library, problem.state)
    return Scheduled(schedule, solved.plan, "proven", solved.planner, EARLIEST_START)


def _improve(
    first: Scheduled | GaveUp, scheduler: Scheduler | None, posed: PosedProblem, problem: MakespanProblem
) -> Scheduled | GaveUp:
    """Return what the scheduler finds if its makespan is shorter, else the first schedule with a note."""
    if scheduler is None:
        return _add_note(first, "a temporal planner may find a shorter one: pip install 'skillc[temporal]'")
    schedule = first.schedule if isinstance(first, Scheduled) else None
    answer = scheduler.schedule(posed.problem, schedule, problem.cancel, problem.report)
    if isinstance(answer, GaveUp):
        return _add_note(first, answer.why)
    lower_bound_s = 0.0 if is_bound_unknown(posed) else answer.at_least_s
    if isinstance(first, Scheduled):
        lower_bound_s = max(lower_bound_s, first.at_least_s or 0.0)
        first = _rate(first, lower_bound_s)
    try:
        plan, tight = _tighten(answer.schedule, problem)
    except PlanError as error:
        return _add_note(first, f"{scheduler.name} returned a schedule that does not work: {error}")
    if isinstance(first, Scheduled) and tight.makespan_s >= first.schedule.makespan_s - TOLERANCE_S:
        return first if first.optimal == "proven" else _add_note(first, f"{scheduler.name} found none that is shorter")
    found = Scheduled(tight, plan, "best found", scheduler.name, scheduler.name)
    found = replace(found, left_out=posed.left_out, assumptions=posed.assumptions)
    return _rate(found, lower_bound_s)


def _add_note(answer: Scheduled | GaveUp, note: str) -> Scheduled | GaveUp:
    if isinstance(answer, GaveUp):
        return GaveUp(f"{answer.why}; {note}")
    return replace(answer, note=note)


def _tighten(schedule: Schedule, problem: MakespanProblem) -> tuple[Plan, Schedule]:
    """Return the steps in an order that works sequentially, and the schedule with the earliest times for it.

    A temporal planner leaves gaps between steps, and orders simultaneous events in ways that running steps cannot.
    """
    library, state, goal = problem.library, problem.state, problem.goal
    by_start = tuple(each.step for each in schedule.steps)
    by_end = tuple(each.step for each in sorted(schedule.steps, key=lambda each: each.end_s))
    try:
        validate(Plan(by_start, 0.0), library, state, goal)
        steps = by_start
    except PlanError:
        validate(Plan(by_end, 0.0), library, state, goal)
        steps = by_end
    plan = Plan(steps, compute_work_s(Plan(steps, 0.0), library, state))
    tight = schedule_plan(plan, library, state)
    simulate_schedule(tight, library, state, goal)
    return plan, tight


def _rate(answer: Scheduled, lower_bound_s: float) -> Scheduled:
    if answer.schedule.makespan_s <= lower_bound_s + TOLERANCE_S:
        return replace(answer, optimal="proven")
    return replace(answer, at_least_s=lower_bound_s or None)
