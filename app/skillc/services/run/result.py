"""Makes the result of a run from what was sampled; `run_report` writes its report, if one is wanted."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from skillc.errors import RequestError, ServiceError
from skillc.services.recording.picture_making import Pictures
from skillc.services.reporting.reporter import Reporter
from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.backend import Backend
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.run_trace import RunTrace
from skillc_runtime.execution.execute import Execution
from skillc_runtime.recording.history.history_builder import HistoryBuilder
from skillc_runtime.recording.run_spec import RunSpec

if TYPE_CHECKING:
    from skillc_runtime.evaluation.report.wiping import WipingDrawing
    from skillc_runtime.film.film import FilmSampler
    from skillc_runtime.film.filmed_cell import FilmedCell

PRIMITIVE_LOOKS = "primitive"


class ReportedRun(msgspec.Struct, frozen=True):
    """The result of a task, and the drawings of its wipings for the report (none without a report).

    `written` is False if a report was requested and could not be written.
    """

    result: TaskResult
    drawings: tuple[WipingDrawing, ...] = ()
    written: bool = True


class RunSamples(msgspec.Struct, frozen=True):
    """What is sampled during a run: the pictures of the film, unless there is to be none, and what devices do."""

    film: FilmSampler | None
    trace: RunTrace

    def sample(self) -> None:
        """Sample what is due; called in every tick."""
        if self.film is not None:
            self.film.sample()
        self.trace.sample()


class ReportDestination(msgspec.Struct, frozen=True):
    """The folder of a report (None: no report), the processes that make its pictures, and the reporter of problems."""

    folder: Path | None
    pictures: Pictures
    reporter: Reporter


def check_film(spec: RunSpec) -> None:
    """RequestError if something is wanted of a film that is not to be made."""
    if spec.film:
        return
    if spec.looks != PRIMITIVE_LOOKS:
        raise RequestError(f"--looks {spec.looks} applies to films and stills, which --no-film leaves out")
    if spec.gif:
        raise RequestError("--gif writes a film, which --no-film leaves out")
    if spec.film_quality != RunSpec().film_quality:
        raise RequestError("--film-quality applies to the film, which --no-film leaves out")


def make_samples(backend: Backend, film: FilmSampler | None = None) -> RunSamples:
    """Return what to sample in a cell, for a film if there is to be one."""
    return RunSamples(film, RunTrace(backend))


def begin_film(backend: Backend, spec: RunSpec, reporter: Reporter) -> FilmSampler | None:
    """Return a film of a cell as a specification wants it; None if that wants none.

    None if the cell cannot be drawn, which is reported. ServiceError if there are no such meshes.
    """
    if not spec.film or spec.out is None:
        return None
    from skillc_runtime.film.film import FilmSampler
    from skillc_runtime.film.filmed_cell import find_filmed

    cell = find_filmed(backend)
    if cell is None:
        reporter.say("no film: this backend cannot be drawn")
        return None
    described = None if spec.looks == PRIMITIVE_LOOKS else _describe_with_meshes(cell, spec.looks)
    return FilmSampler(cell, described, spec.gif, spec.film_quality)


def report_run(
    execution: Execution[Backend],
    builder: HistoryBuilder,
    library: SkillLibrary,
    samples: RunSamples,
    destination: ReportDestination,
) -> ReportedRun:
    """Make the result of a run whose events the `builder` has; write it with the report, and begin its pictures.

    Nothing is written without a folder.
    """
    # What measures is not needed before a run has ended.
    from skillc_runtime.evaluation.report.run_record import RunRecord
    from skillc_runtime.evaluation.report.summary import summarise_run
    from skillc_runtime.evaluation.report.work import measure_work

    backend, history = execution.backend, builder.history
    state, truth = backend.cell.world.snapshot(), backend.capabilities.truth
    record = RunRecord(history, state, truth, samples.trace)
    works, began_s = measure_work(record), samples.trace.began_s
    result = summarise_run(execution, history, record.wipings, backend, works, began_s)
    folder, reporter = destination.folder, destination.reporter
    if folder is None:
        return ReportedRun(result)
    from skillc.services.run.report import DrawnRun, write_run  # what draws takes long to import

    drawings = record.wiping_drawings
    try:
        drawn = DrawnRun(builder.draw() if execution.attempts else [], library, samples.film)
        write_run(folder, result, record, drawn, destination.pictures, reporter)
    except ServiceError as error:
        reporter.say(f"error: {error}")
        return ReportedRun(result, drawings, written=False)
    return ReportedRun(result, drawings)


def _describe_with_meshes(cell: FilmedCell, looks: str) -> Any:
    """Return the `mujoco.MjSpec` of a cell with the meshes of that name. ServiceError if there are none."""
    from skillc_runtime.film.look_meshes import add_looks
    from skillc_runtime.film.looks import LooksError, read_looks

    try:
        wanted = read_looks(cell.world.snapshot(), cell.drawing.prefixes, looks)
        return add_looks(cell.drawing.describe_model(), wanted)
    except LooksError as error:
        raise ServiceError(str(error)) from error
