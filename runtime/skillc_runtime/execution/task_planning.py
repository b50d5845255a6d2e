"""Plans what is to be done in a world, and checks it before anything moves."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import assert_never

import msgspec
from msgspec.structs import replace

from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.assignment import (
    AchieveGoal,
    Assignment,
    NotStarted,
    PreparedTask,
    arrange_prepared,
)
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.refinement.goal_places import name_goal_places
from skillc_runtime.execution.refinement.run_planning import SpaceLook, look_at_body_for_run, plan_for_run
from skillc_runtime.execution.selection.preflight import preflight
from skillc_runtime.planning.makespan import time_limit
from skillc_runtime.planning.makespan.scheduling import keep_apart
from skillc_runtime.planning.objectives.always import find_broken_at_start, plan_keeping
from skillc_runtime.planning.objectives.minimal_cost import minimise_cost
from skillc_runtime.planning.objectives.several import PlanFrom, SeveralTasks, plan_several, refuse_late_tasks
from skillc_runtime.planning.plan import Excluded, GaveUp, Plan, Step, Unsolvable
from skillc_runtime.planning.planners import find_planners
from skillc_runtime.planning.progress import ReportProgress, ignore_progress, reporting_costs
from skillc_runtime.planning.schedule import DEADLINE_S, PlanAnswer, Planners, Scheduled
from skillc_runtime.planning.solve import solve
from skillc_runtime.planning.validation import PlanError, validate
from skillc_runtime.world.state.world_state import WorldState


def prepare_task(
    assignment: Assignment,
    library: SkillLibrary,
    without: Sequence[Step] = (),
    planners: Planners | None = None,
    cancel: CancelToken | None = None,
    report: ReportProgress = ignore_progress,
    look: SpaceLook | None = None,
) -> PreparedTask | NotStarted:
    """Plan if there is a goal, and check everything that would keep the body from running, before anything moves.

    The plan has none of the steps in `without`. `planners` defaults to those that are installed; they search until
    `cancel` ends them, by default for DEADLINE_S. With a `look` the arms can carry out the plan, as far as is known; a
    body that they cannot carry out is not refused.
    """
    cancel = cancel or CancelToken(DEADLINE_S)
    broken = find_broken_at_start(assignment.always, assignment.state)
    if broken is not None:
        return NotStarted(broken, proved=True)
    if isinstance(assignment.objective, AchieveGoal):
        search = _Search(planners or find_planners(), cancel, report, look)
        prepared = _prepare_plan(assignment, assignment.objective, library, without, search)
    else:
        prepared = PreparedTask(assignment, assignment.objective.body, None)
    if isinstance(prepared, NotStarted):
        return prepared
    refusals = preflight(prepared.body, library, assignment.state)
    if refusals:
        return NotStarted("\n".join(map(str, refusals)))
    if prepared.planned is not None or look is None:
        return prepared
    return replace(prepared, space=look_at_body_for_run(library, assignment.state, prepared.body, look, cancel))


def replan_task(
    assignment: Assignment,
    library: SkillLibrary,
    failures: FailedSteps,
    planners: Planners | None = None,
    cancel: CancelToken | None = None,
    report: ReportProgress = ignore_progress,
    look: SpaceLook | None = None,
) -> PreparedTask | NotStarted:
    """Plan without the steps that failed; if there is no such plan, without those that can only fail again.

    Without failures this is `prepare_task`.
    """
    cancel = cancel or CancelToken(DEADLINE_S)
    prepared = prepare_task(assignment, library, failures.steps, planners, cancel, report, look)
    if isinstance(prepared, PreparedTask) or not failures.steps:
        return prepared
    without: tuple[Step, ...] = ()
    while True:
        prepared = prepare_task(assignment, library, without, planners, cancel, report, look)
        if isinstance(prepared, NotStarted) or prepared.planned is None:
            break
        repeated = failures.find_repeated_steps(prepared.planned.steps, assignment.state)
        if not repeated:
            return prepared
        without = (*without, *repeated)
    if without:
        message = "all remaining alternatives have failed, and nothing that they depend on has changed"
        return NotStarted(message, proved=True)
    return prepared


class _Search(msgspec.Struct, frozen=True):
    planners: Planners
    cancel: CancelToken
    report: ReportProgress
    look: SpaceLook | None


def _prepare_plan(
    assignment: Assignment, objective: AchieveGoal, library: SkillLibrary, without: Sequence[Step], search: _Search
) -> PreparedTask | NotStarted:
    def plan(more: Sequence[Excluded]) -> PlanAnswer:
        branch = None if assignment.sensed is None else assignment.sensed.branch
        if branch is not None and not without and not more and _works(branch.plan, assignment, library):
            return branch
        return _plan(assignment, objective, library, (*without, *more), search)

    if search.look is None:
        result, space = plan(()), None
    else:
        result, space = plan_for_run(library, assignment.state, plan, search.look, search.cancel)
        result = name_goal_places(result, objective.goal, assignment.state)
    if isinstance(result, Unsolvable | GaveUp):
        return _refuse(result)
    known = assignment.plan_library(library)
    apart = keep_apart(result, space.apart_pairs if space is not None else (), known, assignment.state)
    kept = refuse_late(assignment, apart, library)
    if isinstance(kept, Unsolvable | GaveUp):
        return _refuse(kept)
    solved = kept.as_solved() if isinstance(kept, Scheduled) else kept
    return arrange_prepared(assignment, solved, library, space)


def _works(plan: Plan, assignment: Assignment, library: SkillLibrary) -> bool:
    """Whether a plan leads to the goal."""
    goal = assignment.plan_goal(library)
    assert goal is not None, "a policy has a goal"
    try:
        validate(plan, assignment.plan_library(library), assignment.state, goal)
    except PlanError:
        return False
    return True


def _refuse(answer: Unsolvable | GaveUp) -> NotStarted:
    """Return that a task does not start because there is no plan; it leads with what the cell lacks or cannot do."""
    proved = isinstance(answer, Unsolvable)
    if not answer.causes:
        return NotStarted(answer.message, proved=proved)
    return NotStarted("; ".join(answer.causes), answer.why, proved)


def _plan(
    assignment: Assignment,
    objective: AchieveGoal,
    library: SkillLibrary,
    without: Sequence[Excluded],
    search: _Search,
) -> PlanAnswer:
    planners, cancel, report = search.planners, search.cancel, search.report

    def search_from(state: WorldState, known: SkillLibrary, goal: Condition) -> PlanAnswer:
        match objective.minimise:
            case "work" | None:
                return solve(known, state, goal, planners.for_work, cancel, without, report=report)
            case "cost":
                work, told = planners.for_work, reporting_costs(report)
                return minimise_cost(
                    known, state, lambda costs: solve(costs, state, goal, work, cancel, without, report=told)
                )
            case "makespan":
                # It is slow to import, and few goals minimise the makespan.
                from skillc_runtime.planning.makespan.minimise import minimise_makespan

                return minimise_makespan(known, state, goal, planners, cancel, without, report)
            case _:
                assert_never(objective.minimise)

    def plan(state: WorldState, goal: Condition) -> PlanAnswer:
        return plan_keeping(assignment.always, library, state, goal, partial(search_from, state))

    return plan_at_once(assignment, library, objective, plan)


def find_several(assignment: Assignment, library: SkillLibrary) -> SeveralTasks | None:
    """Return the tasks that are planned as one; None if there is only one."""
    goal = assignment.plan_goal(library)
    if not assignment.parts or goal is None:
        return None
    return SeveralTasks(assignment.parts, assignment.plan_library(library), assignment.state, goal)


def plan_at_once(assignment: Assignment, library: SkillLibrary, objective: AchieveGoal, plan: PlanFrom) -> PlanAnswer:
    """Return a plan for an objective; what makes plans gets the goals of several tasks at once, or in turn."""
    tasks = find_several(assignment, library)
    if tasks is None:
        return plan(assignment.state, objective.goal)
    return plan_several(tasks, plan, objective.minimise == "makespan")


def refuse_late(assignment: Assignment, answer: PlanAnswer, library: SkillLibrary) -> PlanAnswer:
    """Return an answer, or that there is no plan if the task, or one of several, would be done too late."""
    known = assignment.plan_library(library)
    kept = time_limit.refuse_late(answer, assignment.within_s, known, assignment.state)
    tasks = find_several(assignment, library)
    return kept if tasks is None else refuse_late_tasks(kept, tasks)
