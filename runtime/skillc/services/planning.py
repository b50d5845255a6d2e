"""Planning for the goal of a task, with the planners of this installation and the plans that they made before."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Literal, TypeAlias

from skillc.services.errors import RequestError
from skillc.services.task_loading import LoadedTask
from skillc_dsl import cache
from skillc_runtime.execution.assignment import AchieveGoal
from skillc_runtime.planning.makespan.minimise import minimise_makespan
from skillc_runtime.planning.plan import PlanResult
from skillc_runtime.planning.planners import Planners, find_planners
from skillc_runtime.planning.schedule import Scheduled
from skillc_runtime.planning.solve import solve

Answer: TypeAlias = PlanResult | Scheduled
Measure: TypeAlias = Literal["work", "proven work", "makespan"]
MOST_PLANS = 500
"""So many answers of planners are cached."""


class FolderPlanCache:
    """Answers of planners as files of a folder, for several processes at once."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def get(self, key: str) -> bytes | None:
        """Return what was put under a key, None where there is nothing or where it is damaged."""
        return cache.load(self._folder / key)

    def put(self, key: str, content: bytes) -> None:
        """Store something, and delete the oldest where there is too much."""
        cache.store(self._folder / key, content)
        cache.delete_oldest(self._folder, MOST_PLANS, MOST_PLANS)


def prepare_planners(use_cache: bool) -> Planners:
    """Return the planners of this installation, with the answers in the user's cache folder if wanted."""
    folder = cache.cache_folder() if use_cache else None
    return find_planners(None if folder is None else FolderPlanCache(folder / "plans"))


def plan_goal(loaded: LoadedTask, measure: Measure, planners: Planners, deadline_s: float) -> Answer:
    """Plan for the goal of a task: with little work, also proven to be the least of the whole scene, or to end early.

    RequestError for a task that is a body.
    """
    library, assignment = loaded.library, loaded.assignment
    if not isinstance(assignment.objective, AchieveGoal):
        raise RequestError(f"the task `{assignment.name}` says itself what to do; run it with `skillc run`")
    goal = assignment.objective.goal
    if measure == "makespan":
        return minimise_makespan(library, assignment.state, goal, planners, deadline_s)
    return solve(library, assignment.state, goal, planners.for_work, deadline_s, prove=measure == "proven work")


def with_minimal_makespan(loaded: LoadedTask) -> LoadedTask:
    """Return a task whose plan is to end early; RequestError where there is nothing to plan."""
    assignment = loaded.assignment
    if not isinstance(assignment.objective, AchieveGoal):
        raise RequestError(f"`{assignment.name}` says itself what to do: there is no plan to minimise")
    return replace(loaded, assignment=replace(assignment, objective=AchieveGoal(assignment.objective.goal, "makespan")))
