"""Runs a task in simulation: preparation, execution, recording, film and report."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from skillc.services.errors import RequestError, ServiceError
from skillc.services.files import writing_to
from skillc.services.recorded_run import RecordingOptions, recorded_run
from skillc.services.reporting import Reporter
from skillc.services.task_loading import LoadedTask
from skillc.services.watchdog.process import TICK_TIMEOUT_S
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.devices.simulation import Simulation
from skillc_runtime.evaluation.report.choice_listener import ChoiceListener
from skillc_runtime.evaluation.report.moments import find_moments
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.summary import summarise_run, summarise_start
from skillc_runtime.evaluation.report.wiping import find_wipings
from skillc_runtime.evaluation.report.wiping_drawing import WipingDrawing, make_wiping_drawing
from skillc_runtime.evaluation.report.write import write_figure, write_report, write_result
from skillc_runtime.execution.assignment import Assignment, PreparedTask, prepare_task
from skillc_runtime.execution.execute import Execution, execute_task
from skillc_runtime.execution.planning_job import PlanningJob
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.film.film import Film, FilmFiles, Moment
from skillc_runtime.film.picture_files import FilmError
from skillc_runtime.film.rendering import RenderingError
from skillc_runtime.planning.planners import Planners
from skillc_runtime.recording.events import Event
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.transactions import StoreError

PRIMITIVE_LOOKS = "primitive"
POLL_PERIOD_S = 0.2
"""How often a store is polled, in s of wall time: a server takes a millisecond or more to answer."""


@dataclass(frozen=True, slots=True)
class RunOptions:
    """The folder of recording and report (None: neither), the seed, the planners, and the meshes in films.

    A run in which a tick takes longer than `tick_timeout_s` is ended (0: never). With `prints_json` the caller prints
    the result as JSON, and the watchdog does if the run is interrupted. RequestError for meshes without a folder,
    because then no film is made.
    """

    out: Path | None = None
    seed: int = 0
    planners: Planners | None = None
    looks: str = PRIMITIVE_LOOKS
    tick_timeout_s: float = TICK_TIMEOUT_S
    prints_json: bool = False

    def __post_init__(self) -> None:
        if self.looks != PRIMITIVE_LOOKS and self.out is None:
            raise RequestError(f"--looks {self.looks} applies to films and stills, which require --out")


@dataclass(frozen=True, slots=True)
class RunResult:
    """The result of a task, and the drawings of its wipings for the report (none without a report).

    `written` is False if a report was requested and could not be written.
    """

    result: TaskResult
    drawings: tuple[WipingDrawing, ...] = ()
    written: bool = True


class RunMonitor(Protocol):
    """Monitors a run: called with each event and after each tick."""

    def __call__(self, event: Event) -> None:
        """Receive an event."""
        ...

    def say(self, message: str) -> None:
        """Receive a message about the preparation or the report."""
        ...

    def pace(self, now: float) -> None:
        """Called after each tick with the simulated time in s; may wait, to slow the run down."""
        ...

    def interruption(self) -> AbstractContextManager[Callable[[], bool]]:
        """Return a context in which the run can be interrupted; its value returns whether it has been."""
        ...


class StorePoller:
    """Updates a world model with what other processes write to its store.

    A store that cannot be read is reported once and polled again later.
    """

    def __init__(self, world: WorldModel, reporter: Reporter) -> None:
        self._world, self._reporter = world, reporter
        self._next, self._reported = 0.0, ""

    def poll(self) -> None:
        """Update the world model if POLL_PERIOD_S has passed since the last time."""
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + POLL_PERIOD_S
        try:
            self._world.follow()
            self._reported = ""
        except StoreError as error:
            if str(error) != self._reported:
                self._reported = str(error)
                self._reporter.say(f"warning: {error}")


def run_task(task: LoadedTask, options: RunOptions, monitor: RunMonitor, reporter: Reporter) -> RunResult:
    """Plan, run and report a task; if it cannot start, its status is `refused`.

    ServiceError if the report's folder cannot be created, or there are no meshes of that name.
    """
    monitor.say("preparing")
    prepared = prepare_task(task.assignment, task.library, planners=options.planners)
    if not isinstance(prepared, PreparedTask):
        return _refused(task, options, prepared.reason)
    monitor.say("building the simulation")
    try:
        cell = SimulatedCell(task.world, options.seed)
    except (SheetError, FrameError, StoreError) as error:
        return _refused(task, options, f"the scene cannot be simulated: {error}")
    monitor.say("preparing the film")
    model = None if options.looks == PRIMITIVE_LOOKS else _model_with_meshes(cell, options.looks)
    film = None if options.out is None else Film(cell, model)
    return _run(prepared, task, cell, film, options, monitor, reporter)


def write_comparison(folder: Path, drawings: Sequence[WipingDrawing]) -> Path | None:
    """Write the figure that compares the wipings of several runs and return its file; None without wipings."""
    with writing_to(folder):
        return folder / "wiping.png" if write_figure(folder, drawings) is not None else None


def _refused(task: LoadedTask, options: RunOptions, why: str) -> RunResult:
    return RunResult(TaskResult(task=task.assignment.name, status="refused", seed=options.seed, failure=why))


def _run(
    prepared: PreparedTask,
    task: LoadedTask,
    cell: SimulatedCell,
    film: Film | None,
    options: RunOptions,
    monitor: RunMonitor,
    reporter: Reporter,
) -> RunResult:
    choices = ChoiceListener()
    poller = StorePoller(cell.world, reporter)
    start = summarise_start(task.assignment.name, cell)
    recording = RecordingOptions(options.out, options.tick_timeout_s, options.prints_json)

    with monitor.interruption() as interrupted, recorded_run(start, recording, reporter) as recorded:

        def after_tick() -> None:
            recorded.watchdog.count_tick(cell.now)
            poller.poll()
            monitor.pace(cell.now)
            if film is not None:
                film.sample()

        def replan(assignment: Assignment, failures: FailedSteps) -> PlanningJob:
            return PlanningJob(assignment, task.library, failures, options.planners)

        def is_interrupted() -> bool:
            recorded.watchdog.count_tick(cell.now)
            return interrupted()

        listeners = (choices, monitor, recorded.publisher)
        execution = execute_task(prepared, task.library, cell, listeners, after_tick, is_interrupted, replan)
        recorded.watchdog.disarm()
        return _report(execution, choices, task, cell, film, options, monitor, reporter)


def _report(
    execution: Execution[SimulatedCell],
    choices: ChoiceListener,
    task: LoadedTask,
    simulation: Simulation,
    film: Film | None,
    options: RunOptions,
    monitor: RunMonitor,
    reporter: Reporter,
) -> RunResult:
    """Make the result of a run, and write it with the report if there is a folder."""
    trees = [attempt.tree for attempt in execution.attempts]
    state, truth = simulation.cell.world.snapshot(), simulation.ground_truth
    wipings = find_wipings(trees, choices, state)
    result = summarise_run(execution, choices, task.library, wipings, simulation)
    folder = options.out
    if folder is None or film is None:
        return RunResult(result)
    monitor.say("writing the report")
    drawings = tuple(make_wiping_drawing(wiping, state, truth) for wiping in wipings)
    try:
        with writing_to(folder):
            write_result(folder, result)
            filmed = _write_film(film, folder, find_moments(wipings, trees, choices, state, truth), reporter)
            write_report(folder, result, trees, drawings, filmed)
    except ServiceError as error:
        reporter.say(f"error: {error}")
        return RunResult(result, drawings, written=False)
    return RunResult(result, drawings)


def _model_with_meshes(simulation: Simulation, looks: str) -> Any:
    """Return the MuJoCo model of a cell with the meshes of that name. ServiceError if there are none."""
    from skillc_runtime.film.look_meshes import build_look_model
    from skillc_runtime.film.looks import LooksError, read_looks

    try:
        wanted = read_looks(simulation.cell.world.snapshot(), simulation.drawing.prefixes, looks)
        return build_look_model(simulation.drawing.describe_model(), wanted)
    except LooksError as error:
        raise ServiceError(str(error)) from error


def _write_film(film: Film, folder: Path, wanted: Sequence[Moment], reporter: Reporter) -> FilmFiles | None:
    """Write the film and the stills of the moments; report if they cannot be made."""
    try:
        return film.write(folder, wanted)
    except (FilmError, RenderingError) as error:
        reporter.say(f"no film: {error}")
        return None
