"""Plans for the goal of a task, with the installed planners and a cache of their answers."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from msgspec.structs import replace

from skillc.errors import RequestError
from skillc.services.planning.plan_cache import FolderPlanCache
from skillc.services.tasks.loading import LoadedTask
from skillc_dsl import cache
from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.assignment import AchieveGoal
from skillc_runtime.execution.task_planning import plan_at_once, refuse_late
from skillc_runtime.planning.objectives.always import plan_keeping
from skillc_runtime.planning.objectives.minimal_cost import minimise_cost
from skillc_runtime.planning.plan import Excluded, PlanResult
from skillc_runtime.planning.planners import WritingPlanner, choose_planner, find_planners
from skillc_runtime.planning.problem.neighbourhood import NARROW, PROVING
from skillc_runtime.planning.progress import ReportProgress, ignore_progress, reporting_costs
from skillc_runtime.planning.schedule import PlanAnswer, Planners
from skillc_runtime.planning.solve import solve
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.world.state.world_state import WorldState


def prepare_planners(use_cache: bool, only: str | None = None, write_to: Path | None = None) -> Planners:
    """Return the installed planners, with the plan cache in the user's cache folder if `use_cache`.

    `only` is the name of the one that minimises work. The first one writes its problems to the folder `write_to`.
    RequestError if a planner is not installed, or nothing can be written there.
    """
    folder = cache.cache_folder() if use_cache else None
    planners = find_planners(None if folder is None else FolderPlanCache(folder / "plans"))
    try:
        planners = planners if only is None else choose_planner(planners, only)
        if write_to is not None:
            write_to.mkdir(parents=True, exist_ok=True)
            first, *others = planners.for_work
            planners = replace(planners, for_work=(WritingPlanner(first, write_to), *others))
    except (LookupError, OSError) as error:
        raise RequestError(f"{write_to}: {error.strerror}" if isinstance(error, OSError) else str(error)) from error
    return planners


def plan_goal(
    loaded: LoadedTask,
    planners: Planners,
    cancel: CancelToken,
    report: ReportProgress = ignore_progress,
    without: Sequence[Excluded] = (),
    prove: bool = False,
) -> PlanAnswer:
    """Plan for the goal of a task, with little of what the task minimises.

    `without` are steps that the plan may not contain. `prove` plans with more of a large scene until it is proved that
    there is no less work or cost. RequestError if the task has a body instead of a goal, or a makespan is to be proved.
    """
    library, assignment = loaded.library, loaded.assignment
    if not isinstance(assignment.objective, AchieveGoal):
        name = assignment.name
        shown = f"`skillc graph PATH {name}` shows its steps, `skillc run` runs them"
        raise RequestError(f"the task `{name}` has a body, not a goal, so there is nothing to plan: {shown}")
    objective = assignment.objective
    if prove and objective.minimise == "makespan":
        instead = "for the makespan the answer always has a lower bound"
        raise RequestError(f"to prove the least work requires to minimise work or cost; {instead}")

    def search(state: WorldState, known: SkillLibrary, goal: Condition) -> PlanAnswer:
        if objective.minimise == "makespan":
            # It is slow to import, and few goals minimise the makespan.
            from skillc_runtime.planning.makespan.minimise import minimise_makespan

            return minimise_makespan(known, state, goal, planners, cancel, without, report)
        costs = objective.minimise == "cost"
        size, told = PROVING if prove else NARROW, reporting_costs(report) if costs else report

        def search_work(timed: SkillLibrary) -> PlanResult:
            return solve(timed, state, goal, planners.for_work, cancel, without, size=size, report=told)

        return minimise_cost(known, state, search_work) if costs else search_work(known)

    def plan(state: WorldState, goal: Condition) -> PlanAnswer:
        return plan_keeping(assignment.always, library, state, goal, partial(search, state))

    return plan_at_once(assignment, library, objective, plan)


def keep_within(
    answer: PlanAnswer, space: SpaceClaim | None, loaded: LoadedTask
) -> tuple[PlanAnswer, SpaceClaim | None]:
    """Return an answer with what is known of it in space, or that its plan takes longer than its task may."""
    kept = refuse_late(loaded.assignment, answer, loaded.library)
    return kept, space if kept is answer else None
