"""Makes the result of a run, and writes its report, figure, film and stills."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from skillc.services.errors import ServiceError
from skillc.services.files import writing_to
from skillc.services.reporting import Reporter
from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.simulation import Simulation
from skillc_runtime.evaluation.report.choice_listener import ChoiceListener
from skillc_runtime.evaluation.report.hand_trace import HandTrace
from skillc_runtime.evaluation.report.handling_drawing import make_handling_drawings
from skillc_runtime.evaluation.report.handlings import find_handlings
from skillc_runtime.evaluation.report.moments import find_moments
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.summary import summarise_run
from skillc_runtime.evaluation.report.wiping import find_wipings
from skillc_runtime.evaluation.report.wiping_drawing import WipingDrawing, make_wiping_drawing
from skillc_runtime.evaluation.report.write import write_figure, write_report, write_result
from skillc_runtime.execution.execute import Execution
from skillc_runtime.film.film import Film, FilmFiles, Moment
from skillc_runtime.film.picture_files import FilmError
from skillc_runtime.film.rendering import RenderingError

PRIMITIVE_LOOKS = "primitive"


@dataclass(frozen=True, slots=True)
class RunResult:
    """The result of a task, and the drawings of its wipings for the report (none without a report).

    `written` is False if a report was requested and could not be written.
    """

    result: TaskResult
    drawings: tuple[WipingDrawing, ...] = ()
    written: bool = True


@dataclass(frozen=True, slots=True)
class RunSamples:
    """What is sampled during a run for its report: the pictures of the film, and what hands do."""

    film: Film
    hands: HandTrace

    def sample(self) -> None:
        """Sample what is due; called in every tick."""
        self.film.sample()
        self.hands.sample()


def make_samples(simulation: Simulation, looks: str) -> RunSamples:
    """Return what to sample, the film with the meshes of that name. ServiceError if there are none."""
    film = Film(simulation, None if looks == PRIMITIVE_LOOKS else _model_with_meshes(simulation, looks))
    return RunSamples(film, HandTrace(simulation))


def report_run(
    execution: Execution[Simulation],
    choices: ChoiceListener,
    library: SkillLibrary,
    samples: RunSamples | None,
    folder: Path | None,
    reporter: Reporter,
) -> RunResult:
    """Make the result of a run, and write it with the report and the film to a folder, unless that is None."""
    simulation = execution.backend
    trees = [attempt.tree for attempt in execution.attempts]
    state, truth = simulation.cell.world.snapshot(), simulation.ground_truth
    wipings = find_wipings(trees, choices, state)
    result = summarise_run(execution, choices, library, wipings, simulation)
    if folder is None or samples is None:
        return RunResult(result)
    drawings = tuple(make_wiping_drawing(wiping, state, truth) for wiping in wipings)
    try:
        with writing_to(folder):
            write_result(folder, result)
            filmed = _write_film(samples.film, folder, find_moments(wipings, trees, choices, state, truth), reporter)
            handlings = find_handlings(trees, choices, state)
            handled = make_handling_drawings(handlings, samples.hands, state, truth)
            write_report(folder, result, trees, drawings, filmed, handled)
    except ServiceError as error:
        reporter.say(f"error: {error}")
        return RunResult(result, drawings, written=False)
    return RunResult(result, drawings)


def write_comparison(folder: Path, drawings: Sequence[WipingDrawing]) -> Path | None:
    """Write the figure that compares the wipings of several runs and return its file; None without wipings."""
    with writing_to(folder):
        return folder / "wiping.png" if write_figure(folder, drawings) is not None else None


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
