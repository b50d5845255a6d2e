"""What is to be done in a world, and everything that is checked and planned before anything moves."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import assert_never

import msgspec
from msgspec.structs import replace

from skillc_model.conditions import Condition
from skillc_model.skills import PlanMeasure, SkillLibrary, TaskPart
from skillc_model.tree import Node
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.plans.plan_body import build_plan_body
from skillc_runtime.execution.refinement.goal_places import name_goal_places
from skillc_runtime.execution.refinement.run_planning import SpaceLook, look_at_body_for_run, plan_for_run
from skillc_runtime.execution.selection.preflight import preflight
from skillc_runtime.planning.arrangement import Arrangement, arrange_plan, step_numbers
from skillc_runtime.planning.foresight import foresee
from skillc_runtime.planning.makespan.scheduling import keep_apart
from skillc_runtime.planning.makespan.time_limit import refuse_late
from skillc_runtime.planning.objectives.always import find_broken_at_start, library_that_keeps, plan_keeping
from skillc_runtime.planning.objectives.minimal_cost import minimise_cost
from skillc_runtime.planning.objectives.several import PlanFrom, SeveralTasks, plan_several, refuse_late_tasks
from skillc_runtime.planning.plan import Excluded, GaveUp, Plan, Solved, Step, Unsolvable
from skillc_runtime.planning.planners import Planners, find_planners
from skillc_runtime.planning.progress import ReportProgress, ignore_progress, reporting_costs
from skillc_runtime.planning.schedule import PlanAnswer, Scheduled
from skillc_runtime.planning.solve import DEADLINE_S, solve
from skillc_runtime.planning.validation import PlanError, validate
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.world.state.world_state import WorldState


class AchieveGoal(msgspec.Struct, frozen=True):
    """A goal to plan for, and what the plan minimises; None if nothing is stated, which is work."""

    goal: Condition
    minimise: PlanMeasure | None = None


class ExecuteBody(msgspec.Struct, frozen=True):
    """A body to run as it is."""

    body: Node


class Sensed(msgspec.Struct, frozen=True):
    """What has come of the last step of a policy, as a clause, and how the policy goes on; None if it does not say."""

    why: str
    branch: Solved | None


class Assignment(msgspec.Struct, frozen=True):
    """What is to be done in a world, after what was `sensed` if it goes on with a policy, within a time in s if any.

    `always` are conditions that neither its plan nor its run may break. Several tasks at once are its `parts`: its goal
    is that of all, and those that come first have precedence.
    """

    name: str
    state: WorldState
    objective: AchieveGoal | ExecuteBody
    sensed: Sensed | None = None
    within_s: float | None = None
    always: tuple[Condition, ...] = ()
    parts: tuple[TaskPart, ...] = ()

    def plan_library(self, library: SkillLibrary) -> SkillLibrary:
        """Return the library with which its plans are made and arranged: they keep what holds always."""
        return library_that_keeps(library, self.always).library

    def plan_goal(self, library: SkillLibrary) -> Condition | None:
        """Return the goal of its plans; None if it has a body."""
        if not isinstance(self.objective, AchieveGoal):
            return None
        return library_that_keeps(library, self.always).goal(self.objective.goal)

    def without_times(self) -> Assignment:
        """Return it without the times that its tasks state, for something else limits it."""
        return replace(self, within_s=None, parts=tuple(replace(each, within_s=None) for each in self.parts))

    def several(self, library: SkillLibrary) -> SeveralTasks | None:
        """Return the tasks that are planned as one; None if there is only one."""
        goal = self.plan_goal(library)
        if not self.parts or goal is None:
            return None
        return SeveralTasks(self.parts, self.plan_library(library), self.state, goal)

    def plan(self, library: SkillLibrary, objective: AchieveGoal, plan: PlanFrom) -> PlanAnswer:
        """Return a plan for its objective; what makes plans gets the goals of several tasks at once, or in turn."""
        tasks = self.several(library)
        if tasks is None:
            return plan(self.state, objective.goal)
        return plan_several(tasks, plan, objective.minimise == "makespan")

    def refuse_late(self, answer: PlanAnswer, library: SkillLibrary) -> PlanAnswer:
        """Return an answer, or that there is no plan if the task, or one of several, would be done too late."""
        kept = refuse_late(answer, self.within_s, self.plan_library(library), self.state)
        tasks = self.several(library)
        return kept if tasks is None else refuse_late_tasks(kept, tasks)


class PlannedSteps(msgspec.Struct, frozen=True):
    """The planner's answer, how its steps are arranged, and the steps in the order of the body."""

    solved: Solved
    arrangement: Arrangement
    steps: tuple[Step, ...]


class PreparedTask(msgspec.Struct, frozen=True):
    """An assignment with the body that will run; `planned` is None if the body was given.

    `space` is what is known of the plan, or of the body that was given, in space, None if nobody has looked.
    """

    assignment: Assignment
    body: Node
    planned: PlannedSteps | None
    space: SpaceClaim | None = None


class NotStarted(msgspec.Struct, frozen=True):
    """A task that does not start, the reason in a sentence, and what there is to say besides.

    `proved` if no planner finds a plan, whatever time it has.
    """

    reason: str
    detail: str = ""
    proved: bool = False


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


def arrange_prepared(
    assignment: Assignment, solved: Solved, library: SkillLibrary, space: SpaceClaim | None = None
) -> PreparedTask:
    """Return an assignment with the body of a plan for it; PlanError if the plan does not work.

    `space` is what is known of the plan in space.
    """
    goal, known = assignment.plan_goal(library), assignment.plan_library(library)
    arrangement = arrange_plan(solved.plan, *foresee(known, assignment.state, goal))
    steps = tuple(solved.plan.steps[number] for number in step_numbers(arrangement))
    body = build_plan_body(solved.plan, arrangement, library, space)
    return PreparedTask(assignment, body, PlannedSteps(solved, arrangement, steps), space)


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
    kept = assignment.refuse_late(apart, library)
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

    return assignment.plan(library, objective, plan)
