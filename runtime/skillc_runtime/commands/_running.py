"""Running a mission for the commands: progress, interruption, recording, report."""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryFile
from types import FrameType

import click

from skillc_runtime.commands import _looks
from skillc_runtime.commands._following import Follower
from skillc_runtime.commands._live import Live
from skillc_runtime.commands._mission import Mission
from skillc_runtime.evaluation.report.choices import Choices
from skillc_runtime.evaluation.report.drawing import Drawing, make_drawing
from skillc_runtime.evaluation.report.moments import find_moments
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.summary import summarise
from skillc_runtime.evaluation.report.wiping import find_wipings
from skillc_runtime.evaluation.report.write import write_report
from skillc_runtime.execution.assignment import PreparedTask, prepare_task
from skillc_runtime.execution.task_run import execute_task
from skillc_runtime.planning.planners import Planners
from skillc_runtime.recording.events import Listener
from skillc_runtime.recording.writer import TraceWriter
from skillc_runtime.simulation.cell import SimulatedCell
from skillc_runtime.simulation.film import Film, Filmed, Moment
from skillc_runtime.simulation.pictures import FilmError
from skillc_runtime.simulation.rendering import RenderingError
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.transactions import StoreError


@dataclass(frozen=True, slots=True)
class Options:
    """How to run: where reports go (None: nowhere), which seed, at which pace, whether to show progress, who plans,
    whose meshes films show.
    """

    out: Path | None = None
    seed: int = 0
    real_time: bool = False
    quiet: bool = False
    planners: Planners | None = None
    looks: str = _looks.PRIMITIVE


@dataclass(frozen=True, slots=True)
class Ran:
    """What became of a mission, and what is drawn of its wipings; nothing where no report was asked for.

    `written` is False where a report was asked for and could not be written.
    """

    result: TaskResult
    drawings: tuple[Drawing, ...] = ()
    written: bool = True


def run(mission: Mission, options: Options) -> Ran:
    """Plan, run and report one mission."""
    name = mission.assignment.name
    with Live(name, options.quiet, options.real_time) as live:
        live.say("preparing")
        prepared = prepare_task(mission.assignment, mission.library, planners=options.planners)
        if not isinstance(prepared, PreparedTask):
            return Ran(TaskResult(task=name, status="refused", seed=options.seed, failure=prepared.reason))
        live.say("building the simulation")
        try:
            cell = SimulatedCell(mission.world, options.seed)
        except (SheetError, FrameError, StoreError) as error:
            failure = f"the scene cannot be simulated: {error}"
            return Ran(TaskResult(task=name, status="refused", seed=options.seed, failure=failure))
        live.say("preparing the film")
        drawn = _looks.drawn(cell, options.looks)
        film = None if options.out is None else Film(cell, drawn)
        return _run(prepared, mission, cell, film, options, live)


def _run(
    prepared: PreparedTask, mission: Mission, cell: SimulatedCell, film: Film | None, options: Options, live: Live
) -> Ran:
    choices = Choices()
    listeners: list[Listener] = [choices, live]
    follow = Follower(cell.world, lambda warning: click.echo(warning, err=True))

    def watch() -> None:
        follow()
        live.pace(cell.now)
        if film is not None:
            film.sample()

    with _interruption() as interruption:
        with _trace(options.out) as trace:
            if trace is not None:
                listeners.append(trace)
            execution = execute_task(prepared, mission.library, cell, listeners, watch, lambda: interruption.wanted)
        trees = [attempt.tree for attempt in execution.attempts]
        wipings = find_wipings(trees, choices, cell)
        result = summarise(execution, choices, mission.library, wipings)
        if options.out is None or film is None:
            return Ran(result)
        live.say("writing the report")
        drawings = tuple(make_drawing(wiping, cell) for wiping in wipings)
        try:
            filmed = _filmed(film, options.out, find_moments(wipings, trees, choices, cell))
            write_report(options.out, result, execution, drawings, filmed)
        except OSError as error:
            click.echo(_refusal(options.out, error), err=True)
            return Ran(result, drawings, written=False)
    return Ran(result, drawings)


def _filmed(film: Film, directory: Path, wanted: Sequence[Moment]) -> Filmed | None:
    """Write the film and the stills that are wanted; say so where there can be none."""
    try:
        return film.write(directory, wanted)
    except (FilmError, RenderingError) as error:
        click.echo(f"no film: {error}", err=True)
        return None


class _Interruption:
    """Whether somebody pressed Ctrl-C: the run is halted and reported; a second time ends the program at once."""

    def __init__(self) -> None:
        self.wanted = False

    def __call__(self, _signal: int, _frame: FrameType | None) -> None:
        if self.wanted:
            raise KeyboardInterrupt
        self.wanted = True


@contextmanager
def _interruption() -> Iterator[_Interruption]:
    interruption = _Interruption()
    before = signal.signal(signal.SIGINT, interruption)
    try:
        yield interruption
    finally:
        signal.signal(signal.SIGINT, before)


@contextmanager
def _trace(directory: Path | None) -> Iterator[TraceWriter | None]:
    if directory is None:
        yield None
        return
    with writing(directory):
        directory.mkdir(parents=True, exist_ok=True)
        trace = TraceWriter(directory / "events.jsonl")
    with trace:
        yield trace
    if trace.problem is not None:
        click.echo(f"warning: {trace.problem}", err=True)


@contextmanager
def writing(directory: Path) -> Iterator[None]:
    """Exit with code 1 and the reason where the folder cannot be written to."""
    try:
        yield
    except OSError as error:
        click.echo(_refusal(directory, error), err=True)
        sys.exit(1)


def _refusal(directory: Path, error: OSError) -> str:
    return f"error: cannot write to {directory}: {error.strerror or error}"


def check_writable(directory: Path | None) -> None:
    """Exit with code 1 where the folder of a report, if one is wanted, cannot be made or written to."""
    if directory is None:
        return
    with writing(directory):
        made = [each for each in (directory, *directory.parents) if not each.exists()]
        directory.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=directory):
            pass
        for each in made:
            each.rmdir()
