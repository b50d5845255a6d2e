"""Looks at a task in space as `skillc plan` does, and runs it in a world in which all is as the scene says."""

from __future__ import annotations

from collections.abc import Callable

from judged_looks.verdict import Said, Verdict
from skillc.services.cell_checks.starting import find_start_problem
from skillc.services.planning.planning import plan_goal, prepare_planners
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.tasks.loading import LoadedTask
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.variation.variation import exact_variation
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.assignment import NotStarted
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.execution.refinement.replanning import plan_in_space
from skillc_runtime.execution.refinement.run_planning import SpaceLook
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.planning.plan import Unsolvable
from skillc_runtime.recording.failure_text import describe_failure
from skillc_runtime.world.state.model import WorldModel

LIMIT_S = 120.0
"""How long plans for a task are looked at, by the look that is judged and in a run, also on a busy machine."""


def judge_task(task: LoadedTask, seed: int, kind: str, search: Callable[[SimulatedCell], str | None]) -> Verdict:
    """Judge what is said of a task; `search` returns a way to do it in a cell, None if it finds none."""
    problem = find_start_problem(task, SilentReporter())
    if problem is not None:
        said, why = "no", problem
    else:
        said, why = look(task)
    cell = make_ideal_cell(task)
    match said:
        case "yes":
            failure = _run(task, cell)
            return Verdict(seed, kind, said, failure is None, failure or "")
        case "no":
            way = search(cell)
            return Verdict(seed, kind, said, way is None, why if way is None else f"{why}; it goes {way}")
        case _:
            return Verdict(seed, kind, said, None, why)


def look(task: LoadedTask) -> tuple[Said, str]:
    """Return what a look says of a task, and why."""
    cancel, planners = CancelToken(LIMIT_S), prepare_planners(False)
    state = task.assignment.state
    answer, found = plan_in_space(
        task.library, state, lambda without: plan_goal(task, planners, cancel, without=without), cancel
    )
    if cancel.reason is not None:
        return "unknown", cancel.reason
    if found is None:
        return ("no" if isinstance(answer, Unsolvable) else "unknown"), str(getattr(answer, "why", ""))
    if found.failed is None:
        return "yes", ""
    failure = found.failure
    if failure is None or not failure.is_in_space:
        return "unknown", "" if failure is None else failure.message
    return "no", f"{failure.cause}: {failure.message}"


def make_ideal_cell(task: LoadedTask) -> SimulatedCell:
    """Return a cell in which all is as the scene says."""
    return SimulatedCell(WorldModel(task.assignment.state), 0, reality=lambda scene, _: exact_variation(scene))


def _run(task: LoadedTask, cell: SimulatedCell) -> str | None:
    """Run the task with a plan that is looked at; return why it failed, None if it did not."""
    prepared = prepare_task(task.assignment, task.library, cancel=CancelToken(LIMIT_S), look=SpaceLook())
    if isinstance(prepared, NotStarted):
        return prepared.reason
    execution = execute_task(prepared, task.library, cell)
    if execution.status == "succeeded":
        return None
    return f"{cell.now:.1f} s: {describe_failure(execution.failure) if execution.failure else execution.status}"
