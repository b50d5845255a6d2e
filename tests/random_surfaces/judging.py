"""Judges what a look in space says of wiping a surface: a yes by a run with physics, a no by a dense search."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Literal, TypeAlias

import msgspec

from random_cells.drawing import ArmName
from random_surfaces.dense_search import DenseSearch
from random_surfaces.drawing import Surface, draw_surface, format_scene
from skillc.services import libraries
from skillc.services.cell_checks.starting import find_start_problem
from skillc.services.library_files import SHIPPED, find_library
from skillc.services.planning import plan_goal, prepare_planners
from skillc.services.reporting import SilentReporter
from skillc.services.task_loading import LoadedTask
from skillc_model.skills import SkillLibrary
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.variation import exact_variation
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, NotStarted, prepare_task
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.refinement.replanning import plan_in_space
from skillc_runtime.planning.plan import Unsolvable
from skillc_runtime.recording.failure_text import describe_failure
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

Said: TypeAlias = Literal["yes", "no", "from another posture", "unknown", "refused"]
"""What is said before anything moves: that it goes, that it does not, that it goes from a posture that a run does not
take, nothing, or that something in the scene is wrong."""

LIMIT_S = 120.0
"""How long plans for a surface are looked at."""


class Verdict(msgspec.Struct, frozen=True):
    """What was said of the surface of a seed, whether it is so, and why not; None where nothing can show it."""

    seed: int
    arm: ArmName
    said: Said
    is_so: bool | None
    why: str


@cache
def load_library() -> SkillLibrary:
    """Return the shipped library of wiping."""
    return libraries.compile_library(find_library(SHIPPED / "wiping")).value


def judge(seed: int, arm: ArmName, folder: Path) -> Verdict:
    """Judge what is said of the surface of a seed; its scene is written into a folder."""
    surface = draw_surface(seed, arm)
    task = load_surface(surface, folder / f"{arm}_{seed}.ttl")
    problem = find_start_problem(task, SilentReporter())
    if problem is not None:
        return Verdict(seed, arm, "refused", None, problem)
    said, why = look(task)
    cell = make_ideal_cell(task)
    match said:
        case "yes" | "from another posture":
            failure = _run(task, cell)
            return Verdict(seed, arm, said, (failure is None) == (said == "yes"), failure or "")
        case "no":
            found = DenseSearch(cell.model, surface).solves()
            start = "" if found is None else f"; it goes from {found.round(2).tolist()}"
            return Verdict(seed, arm, said, found is None, why + start)
        case _:
            return Verdict(seed, arm, said, None, why)


def load_surface(surface: Surface, scene: Path) -> LoadedTask:
    """Return the task to wipe a surface, whose scene is written."""
    scene.parent.mkdir(parents=True, exist_ok=True)
    scene.write_text(format_scene(surface), "utf-8")
    library = load_library()
    state = load_scene(scene, library.vocabulary)
    goal = library.tasks["clean_desk"].goal
    assert goal is not None
    assignment = Assignment("clean_desk", state, AchieveGoal(goal))
    return LoadedTask(library, assignment, WorldModel(state), str(scene))


def look(task: LoadedTask) -> tuple[Said, str]:
    """Return what a look says of a task, and why."""
    cancel, planners = CancelToken(LIMIT_S), prepare_planners(False)
    state = task.assignment.state
    answer, found = plan_in_space(
        task.library, state, lambda without: plan_goal(task, "work", planners, cancel, without=without), cancel
    )
    if cancel.reason is not None:
        return "unknown", cancel.reason
    if found is None:
        return ("no" if isinstance(answer, Unsolvable) else "unknown"), str(answer.why)
    if found.failed is None:
        chosen = any(motion.chosen for step in found.steps for motion in step.motions)
        return ("from another posture" if chosen else "yes"), ""
    failure = found.failure
    return (
        ("unknown", "") if failure is None or not failure.is_in_space else ("no", f"{failure.cause}: {failure.message}")
    )


def make_ideal_cell(task: LoadedTask) -> SimulatedCell:
    """Return a cell in which all is as the scene says."""
    return SimulatedCell(WorldModel(task.assignment.state), 0, reality=lambda scene, _: exact_variation(scene))


def _run(task: LoadedTask, cell: SimulatedCell) -> str | None:
    """Run the task; return why it failed, None if it did not."""
    prepared = prepare_task(task.assignment, task.library)
    if isinstance(prepared, NotStarted):
        return prepared.reason
    execution = execute_task(prepared, task.library, cell)
    if execution.status == "succeeded":
        return None
    return f"{cell.now:.1f} s: {describe_failure(execution.failure) if execution.failure else execution.status}"
