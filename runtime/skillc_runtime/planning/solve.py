"""From a goal to a validated plan: pose the problem, plan, validate in the world model, explain if there is no plan."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

import msgspec
from msgspec import structs
from msgspec.structs import replace

from skillc_model.conditions import Condition
from skillc_model.pddl.problem import Problem
from skillc_model.skills import SkillLibrary
from skillc_model.traversal import conjuncts
from skillc_runtime.cancellation import Cancelled, CancelToken, cancelling
from skillc_runtime.planning.abstraction.stages import PlanningStages, plan_in_stages
from skillc_runtime.planning.foresight import explain_unsupported, foresee
from skillc_runtime.planning.plan import (
    Excluded,
    GaveUp,
    Optimal,
    Plan,
    Planner,
    PlanResult,
    Solved,
    Unsolvable,
)
from skillc_runtime.planning.planners import list_planners
from skillc_runtime.planning.policy import make_policy
from skillc_runtime.planning.problem.chains import UnrolledProblem, unroll_chains
from skillc_runtime.planning.problem.initial_state import TooManyValues
from skillc_runtime.planning.problem.neighbourhood import NARROW, NARROWEST, AbstractionSize
from skillc_runtime.planning.problem.pose import GoalError, PosedProblem, already_holds
from skillc_runtime.planning.progress import PlanningProgress, ReportProgress, ignore_progress
from skillc_runtime.planning.schedule import DEADLINE_S
from skillc_runtime.planning.validation import PlanError, compute_work_s, follow_plan, validate
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

if TYPE_CHECKING:
    from skillc_runtime.planning.unsolvability import UnsolvabilityReason


def solve(
    library: SkillLibrary,
    state: WorldState,
    goal: Condition,
    planners: Sequence[Planner] | None = None,
    cancel: CancelToken | None = None,
    without: Sequence[Excluded] = (),
    *,
    size: AbstractionSize | None = NARROW,
    report: ReportProgress = ignore_progress,
) -> PlanResult:
    """Return a plan from a version of the world to the goal, validated in the world model.

    `without` are steps that the plan may not contain. In a large scene only the part near the goal is considered at
    first, as large as `size` says. If a planner gives up, the next one gets the remaining time, until `cancel` ends the
    search, by default after DEADLINE_S. A goal that already holds has the empty plan, even if planners cannot express
    it; for one that does not hold and cannot be expressed, nothing is searched. Planners `report` how far they are, for
    the part that they plan with. A plan with steps of which different outcomes may come is a policy.
    """
    cancel = cancel or CancelToken(DEADLINE_S)
    chosen = tuple(list_planners() if planners is None else planners)

    def plan(world: WorldState, left_out: Sequence[Excluded], part: CancelToken) -> PlanResult:
        return _solve_for_what_suits(library, world, goal, chosen, part, left_out, size, report)

    line = plan(state, without, cancel)
    if not isinstance(line, Solved):
        return line
    return make_policy(line, *foresee(library, state, goal), goal, plan, without, cancel)


def _solve_for_what_suits(
    library: SkillLibrary,
    state: WorldState,
    goal: Condition,
    chosen: tuple[Planner, ...],
    cancel: CancelToken,
    without: Sequence[Excluded],
    size: AbstractionSize | None,
    report: ReportProgress,
) -> PlanResult:
    """Return a plan that chooses what comes of its steps."""
    try:
        with cancelling(cancel):
            if already_holds(goal, state):
                return Solved(Plan((), 0.0), "proven", "the world as it is")
            unsupported = explain_unsupported(goal, state)
            if unsupported is not None:
                return GaveUp(unsupported, searched=False)
            library, state = foresee(library, state, goal)
            task = _Task(unroll_chains(library, state, goal), state, goal, tuple(without), size, chosen, report)
        with cancelling(cancel):
            stages = PlanningStages(
                partial(task.unrolled.pose, without), task.answer, task.search, task.explain, task.sketch, cancel
            )
            return plan_in_stages(stages, task.unrolled.state, size)
    except GoalError as reason:
        return GaveUp(str(reason), searched=False)
    except Cancelled as reason:
        return GaveUp(str(reason))


class _Task(msgspec.Struct, frozen=True):
    """What is planned: as it is posed for planners, and the world and the goal with which plans are validated."""

    unrolled: UnrolledProblem
    state: WorldState
    goal: Condition
    without: tuple[Excluded, ...]
    size: AbstractionSize | None
    planners: tuple[Planner, ...]
    report: ReportProgress

    def answer(self, posed: PosedProblem, part: CancelToken) -> PlanResult:
        """Return the answer of the first planner that has one, validated."""

        def report_part(progress: PlanningProgress) -> None:
            self.report(structs.replace(progress, individuals=len(posed.problem.objects), narrowed=posed.narrowed))

        return _plan_and_validate(self, posed, part, report_part)

    def search(self, problem: Problem, part: CancelToken) -> PlanResult:
        """Return what the first planner finds, which nothing validates."""
        return self.planners[0].plan(problem, part, ignore_progress)

    def sketch(self, posed: PosedProblem, part: CancelToken) -> Solved | None:
        """Return some plan, found goal by goal, validated; None if none was found in this way."""
        try:
            with cancelling(part):
                found = _validate(_plan_goal_by_goal(self, part), posed, self)
        except (PlanError, GoalError, EvaluationError, TooManyValues, Cancelled):
            return None
        if not isinstance(found, Solved):
            return None
        self.report(PlanningProgress(planner=found.planner, best_s=found.plan.duration_s))
        return found

    def explain(self, posed: PosedProblem) -> UnsolvabilityReason:
        """Return why a problem has no plan."""
        # Most problems have a plan, and what explains why one has none is slow to import.
        from skillc_runtime.planning.unsolvability import explain_unsolvable, pose_to_explain

        state, goal = self.unrolled.state, self.unrolled.goal
        whole = posed if posed.narrowed else pose_to_explain(posed, state, goal, self.without, self.size)
        return explain_unsolvable(whole, goal, state)


def _plan_goal_by_goal(task: _Task, cancel: CancelToken) -> PlanResult:
    """Return a plan that reaches one part of the goal after another; PlanError, GoalError, EvaluationError."""
    from skillc_runtime.planning.abstraction.goal_by_goal import plan_goal_by_goal
    from skillc_runtime.planning.search.greedy import GreedySearch

    planner, library = GreedySearch(), task.unrolled.whole

    def solve_part(world: WorldState, part: Condition) -> PlanResult:
        unrolled = unroll_chains(library, world, part)
        for size in (NARROWEST, NARROW):
            posed = unrolled.pose(task.without, size, keep_unneeded=True)
            result = planner.plan(posed.problem, cancel)
            if isinstance(result, Solved):
                break
        return result

    def follow(plan: Plan, world: WorldState) -> WorldState:
        return follow_plan(plan, library, world)[-1]

    parts = tuple(conjuncts(task.goal))
    steps = plan_goal_by_goal(parts, task.state, solve_part, follow)
    if steps is None:
        return GaveUp("no plan was found goal by goal")
    work_s = compute_work_s(Plan(steps, 0.0), library, task.state)
    return Solved(Plan(steps, work_s), "best found", planner.name)


def _plan_and_validate(task: _Task, posed: PosedProblem, cancel: CancelToken, report: ReportProgress) -> PlanResult:
    failures: list[str] = []
    for planner in task.planners:
        report(PlanningProgress(planner=planner.name))
        try:
            with cancelling(cancel):
                result = _validate(planner.plan(posed.problem, cancel, report), posed, task)
        except Cancelled as reason:
            result = GaveUp(str(reason))
        match result:
            case Solved() | Unsolvable():
                return result
            case GaveUp(why):
                failures.append(why)
    return GaveUp(cancel.cancelled_because or "; ".join(failures))


def _validate(result: PlanResult, posed: PosedProblem, task: _Task) -> PlanResult:
    if not isinstance(result, Solved):
        return result
    try:
        validate(result.plan, task.unrolled.whole, task.state, task.goal)
        work_s = compute_work_s(result.plan, task.unrolled.whole, task.state)
    except PlanError as error:
        return GaveUp(f"{result.planner} returned a plan that does not work: {error}")
    return (
        _mark_as_estimate(result, work_s, posed.assumptions) if posed.assumptions else _check_duration(result, work_s)
    )


def _check_duration(solved: Solved, work_s: float) -> PlanResult:
    if work_s == solved.plan.duration_s:
        return solved
    return GaveUp(
        f"{solved.planner} returned a plan that does not work: it takes {work_s:g} s, not {solved.plan.duration_s:g}"
    )


def _mark_as_estimate(solved: Solved, work_s: float, assumptions: tuple[str, ...]) -> Solved:
    """Return a plan without the claims that depend on durations that are estimates."""
    optimal: Optimal = "best found" if solved.optimal == "best found" else "optimal for approximate durations"
    plan = replace(solved.plan, duration_s=work_s)
    return replace(solved, plan=plan, optimal=optimal, at_least_s=None, assumptions=assumptions)
