"""Runs a task in a cell: planning beside the building of the cell, execution, recording, film and report."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import AbstractContextManager, closing, nullcontext
from functools import partial
from pathlib import Path
from time import perf_counter

import msgspec
from msgspec.structs import replace

from skillc.errors import RequestError, ServiceError
from skillc.services.cell_checks.starting import find_start_problem
from skillc.services.project.backends import SIMULATED, adapt_library, check_pace, make_backend
from skillc.services.project.project import DEFAULT_BACKEND, SYMBOLIC
from skillc.services.recording.picture_making import Pictures, making_pictures
from skillc.services.reporting.reporter import Reporter
from skillc.services.run.operating import RunMonitor, operate
from skillc.services.run.real_devices import check_reality, with_reality
from skillc.services.run.recorded_run import RecordingOptions, recorded_run
from skillc.services.run.recordings import KnownStart, describe_contents, find_obstacle, recorded_in
from skillc.services.run.result import (
    PRIMITIVE_LOOKS,
    ReportDestination,
    ReportedRun,
    RunSamples,
    begin_film,
    check_film,
    make_samples,
    report_run,
)
from skillc.services.run.signal_files import check_signals, recorded_signals
from skillc.services.run.unstarted_runs import CannotBegin, end_unstarted
from skillc.services.scene.store_polling import POLL_PERIOD_S, StorePoller
from skillc.services.space.run_looks import look_from, look_from_home
from skillc.services.tasks.breakpoints import make_gate
from skillc.services.tasks.loading import LoadedTask, with_measure
from skillc.services.watchdog.process import TICK_TIMEOUT_S
from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.reality import IDEAL
from skillc_runtime.evaluation.report.run_start import summarise_start
from skillc_runtime.execution.assignment import Assignment, NotStarted
from skillc_runtime.execution.attempt import CellOrigin
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.execute import describe_execution, prepare_after
from skillc_runtime.execution.planning_job import PlanningJob
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.refinement.run_planning import SpaceLook
from skillc_runtime.execution.tree.gate import Gate
from skillc_runtime.planning.schedule import DEADLINE_S, Planners
from skillc_runtime.recording.envelope import Recorder, make_run_id
from skillc_runtime.recording.history.history_builder import HistoryBuilder
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.transactions import StoreError


class RunOptions(msgspec.Struct, frozen=True):
    """What a run is given, and how this process carries it out.

    Without the folder `out` of its specification, `record_in` may be one for the MCAP file alone.
    A run in which a tick takes longer than `tick_timeout_s` is ended with its process (0: only if that dies, None: no
    process watches it). `run_id` is the id of the run, empty for a new one; `recorders` get its events as they are
    recorded. With `prints_json` the caller prints the result as JSON, and the watchdog does if the run is interrupted.
    The devices are as in `saved`, a checkpoint of the backend, if it is given.

    RequestError for meshes or a loop without a folder, because then no film is made, and for signals that cannot be
    recorded.
    """

    spec: RunSpec = msgspec.field(default_factory=RunSpec)
    find_planners: Callable[[], Planners] | None = None
    tick_timeout_s: float | None = TICK_TIMEOUT_S
    prints_json: bool = False
    saved: bytes | None = None
    run_id: str = ""
    recorders: tuple[Recorder, ...] = ()
    record_in: Path | None = None

    def __post_init__(self) -> None:
        spec = self.spec
        if spec.looks != PRIMITIVE_LOOKS and spec.out is None:
            raise RequestError(f"--looks {spec.looks} applies to films and stills, which require --out")
        check_signals(spec.signals, spec.out)
        if spec.gif and spec.out is None:
            raise RequestError("--gif writes a film, which requires --out")
        check_film(spec)

    @property
    def out(self) -> Path | None:
        """The folder of recording and report; None for neither."""
        return None if self.spec.out is None else Path(self.spec.out)


def run_task(
    task: LoadedTask, options: RunOptions, monitor: RunMonitor, reporter: Reporter, pictures: Pictures | None = None
) -> ReportedRun:
    """Plan, run and report a task; if it cannot start, its status is `refused`.

    With `pictures` its figures and film may still be made when this returns.

    KeyboardInterrupt stops a task that has not begun, and breaks off one that runs. RequestError for a breakpoint
    that does not exist, if there is no plan to minimise, and for a pace that the cell cannot have. ServiceError if the
    report's folder cannot be created, there are no meshes of that name, or no process can be started.
    """
    if pictures is None:
        with making_pictures(reporter) as pictures:
            return run_task(task, options, monitor, reporter, pictures)
    spec = replace(options.spec, backend=options.spec.backend or task.backend)
    task, options = replace(task, backend=spec.backend), replace(options, spec=spec)
    if task.backend == SYMBOLIC:
        task, options = _without_bodies(task, options)
    spec = options.spec
    if spec.deadline_s is not None:
        task = replace(task, assignment=task.assignment.without_times())
    task = with_measure(task, spec.minimise)
    if spec.reality is not None:
        task = with_reality(task, spec.reality)
    if spec.dry:
        task = _with_own_world(task)
    gate = make_gate(spec, task.library)
    end = partial(end_unstarted, task, spec)
    problem = None if task.backend == SYMBOLIC else find_start_problem(task, reporter)
    if problem is not None:
        return end("refused", problem, reporter)
    with _plan_ahead(task, options) as planning:
        try:
            monitor.say("planning, and building the cell")
            cell = _make_cell(task, options)
            film = begin_film(cell, spec, reporter)
        except (SheetError, FrameError, StoreError) as error:
            return end("refused", _find_refusal(planning, error), reporter)
        except CannotBegin as error:
            return end("refused", str(error), reporter)
        except KeyboardInterrupt as interrupt:
            return end("stopped", str(interrupt) or "interrupted", reporter)
        with closing(cell):
            check_pace(cell, monitor.pace.factor)
            check_reality(cell, spec.reality or IDEAL)
            destination = ReportDestination(options.out, pictures, reporter)
            return _Run(task, options, cell, make_samples(cell, film), gate, monitor, destination).carry_out(planning)


def _without_bodies(task: LoadedTask, options: RunOptions) -> tuple[LoadedTask, RunOptions]:
    """Return a task whose skills act by what they declare, and options with which nobody looks in space."""
    spec = replace(options.spec, geometry=False)
    return replace(task, library=adapt_library(task.library, task.backend)), replace(options, spec=spec)


def _with_own_world(task: LoadedTask) -> LoadedTask:
    """Return a task in a copy of its world, so that the effects of its simulation do not become facts."""
    return replace(task, world=WorldModel(task.world.snapshot()))


def _make_cell(task: LoadedTask, options: RunOptions) -> Backend:
    spec = options.spec
    if spec.dry:
        # What looks at real devices is slow to import.
        from skillc.services.run.dry_runs import make_dry_cell

        return make_dry_cell(task.backend, spec.seed, task.world)
    return make_backend(task.backend, task.world, spec.seed, options.saved)


class _Run(msgspec.Struct, frozen=True):
    """A task in a cell that has been built."""

    task: LoadedTask
    options: RunOptions
    cell: Backend
    samples: RunSamples
    gate: Gate
    monitor: RunMonitor
    destination: ReportDestination

    @property
    def reporter(self) -> Reporter:
        """The reporter of problems."""
        return self.destination.reporter

    def carry_out(self, planning: PlanningJob | None) -> ReportedRun:
        """Run the task once it is planned, and report it."""
        task, options, cell = self.task, self.options, self.cell
        builder = HistoryBuilder()
        start = summarise_start(task.assignment.name, cell, options.spec.speed)
        run_id = options.run_id or make_run_id(task.assignment.name)
        with (
            self._recorded(run_id) as recorders,
            recorded_run(start, self._describe_recording(run_id, recorders), self.reporter) as recorded,
            recorded_signals(cell, options.spec.signals, options.out, self.reporter) as hooks,
        ):
            loop, began = self._make_loop(planning, hooks), perf_counter()
            publisher = recorded.publisher
            listeners = (builder, self.monitor, publisher)
            run = loop.submit(task.assignment, listeners, options.spec, self.gate, publisher.run)
            operate(loop, run, self.monitor, lambda: recorded.watchdog.count_tick(cell.clock.now))
            recorded.watchdog.disarm()
            execution = describe_execution(run, cell, perf_counter() - began)
            if options.out is not None:
                self.monitor.say("writing the report")
                if (record := cell.capabilities.commands) is not None:
                    from skillc.services.run.dry_runs import write_commands

                    write_commands(record, options.out)
            return report_run(execution, builder, task.library, self.samples, self.destination)

    def _recorded(self, run_id: str) -> AbstractContextManager[tuple[Recorder, ...]]:
        """Record the run as an MCAP file, if there is a folder for it."""
        task, options, state = self.task, self.options, self.cell.cell.world.snapshot()
        folder = options.out or options.record_in
        if folder is None:
            return nullcontext(())
        name, obstacle = task.assignment.name, find_obstacle(self.cell)
        start = KnownStart(state, checkpoint=options.saved or b"", obstacle=obstacle)
        describe = partial(describe_contents, run_id, name, task.library, start, self._origin, options.spec)
        return recorded_in(folder, describe, self.cell, self.reporter)

    def _describe_recording(self, run_id: str, recorders: tuple[Recorder, ...]) -> RecordingOptions:
        options = self.options
        return RecordingOptions(
            options.out, options.tick_timeout_s, options.prints_json, run_id, (*options.recorders, *recorders)
        )

    def _make_loop(self, planning: PlanningJob | None, recording: tuple[Callable[[], None], ...]) -> CellLoop:
        def plan_again(assignment: Assignment, failures: FailedSteps) -> PlanningJob:
            spec, library = self.options.spec, self.task.library
            look = look_from(self.cell.cell, library, spec.plan_cache) if spec.geometry else None
            return _start_planning(self.task, assignment, failures, self.options, look, self.cell.clock.now)

        world = self.cell.cell.world
        poller, follow_s = StorePoller(world, self.reporter), POLL_PERIOD_S if world.is_stored else math.inf
        hooks = (poller.poll, *recording, self.samples.sample)
        preparation = plan_again if planning is None else prepare_after(planning, plan_again)
        return CellLoop(self.cell, self.task.library, preparation, self._origin, hooks, follow_s=follow_s)

    @property
    def _origin(self) -> CellOrigin:
        spec = self.options.spec
        return CellOrigin(self.task.scene, spec.seed, DEFAULT_BACKEND if spec.dry else self.task.backend)


def find_planners(use_cache: bool) -> Planners:
    """Return the installed planners, for the process that plans; they are slow to import."""
    from skillc.services.planning.planning import prepare_planners

    return prepare_planners(use_cache)


def _plan_ahead(task: LoadedTask, options: RunOptions) -> AbstractContextManager[PlanningJob | None]:
    """Start to plan before there is a cell; None where only the cell can tell from where its arms begin."""
    spec = options.spec
    at_home = task.backend in SIMULATED and not spec.dry and options.saved is None
    if spec.geometry and not at_home:
        return nullcontext()
    look = look_from_home(task.library, spec.plan_cache) if spec.geometry else None
    return _start_planning(task, task.assignment, FailedSteps(task.library), options, look)


def _start_planning(
    task: LoadedTask,
    assignment: Assignment,
    failures: FailedSteps,
    options: RunOptions,
    look: SpaceLook | None,
    now: float = 0.0,
) -> PlanningJob:
    """Start a worker that plans, for as long as the deadline of the task leaves at the time `now` of the cell in s."""
    limit_s = options.spec.deadline_s
    left_s = DEADLINE_S if limit_s is None else min(DEADLINE_S, max(0.0, limit_s - now))
    try:
        return PlanningJob(assignment, task.library, failures, options.find_planners, deadline_s=left_s, look=look)
    except OSError as error:
        raise ServiceError(f"no process can be started that plans: {error.strerror or error}") from error


def _find_refusal(planning: PlanningJob | None, error: Exception) -> str:
    """Return why a task cannot start whose scene cannot be simulated: what planning finds says more about it."""
    answer = None if planning is None else planning.wait(DEADLINE_S)
    return answer.reason if isinstance(answer, NotStarted) else f"the scene cannot be simulated: {error}"
