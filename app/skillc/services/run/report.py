"""Writes the result of a run with its report into a folder, and begins its figures, film and stills."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from skillc.services.recording.picture_making import PictureOrder, Pictures
from skillc.services.reporting.files import writing_to
from skillc.services.reporting.reporter import Reporter
from skillc_model.skills import SkillLibrary
from skillc_runtime.evaluation.report.figure import DrawnFigure, number_files
from skillc_runtime.evaluation.report.film_story import find_moments, make_story
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.run_record import RunRecord
from skillc_runtime.evaluation.report.wiping import WipingDrawing
from skillc_runtime.evaluation.report.work_figures import list_figures, make_wiping_figure
from skillc_runtime.evaluation.report.write import ReportPages, write_figures, write_page, write_result
from skillc_runtime.film.film import FilmSampler
from skillc_runtime.film.footage import Footage
from skillc_runtime.film.picture_files import FilmError
from skillc_runtime.recording.history.node_outcome import NodeOutcome


@dataclass(frozen=True, slots=True)
class DrawnRun:
    """What is drawn of a run: its trees, with the skills of a library, and its film if it was sampled."""

    trees: Sequence[NodeOutcome]
    library: SkillLibrary
    film: FilmSampler | None


def write_run(
    folder: Path, result: TaskResult, record: RunRecord, drawn: DrawnRun, pictures: Pictures, reporter: Reporter
) -> None:
    """Write a run with its trees, and begin its pictures. ServiceError if nothing can be written."""
    with writing_to(folder):
        write_result(folder, result)
        footage = _find_footage(result, record, drawn, reporter)
        film = None if footage is None else footage.files
        figures = number_files(list_figures(record))
        pages = ReportPages(result, drawn.trees, tuple(map(DrawnFigure, figures)), film)
        write_page(folder, pages.begun)
        if figures or footage is not None:
            pictures.begin(PictureOrder(result.task, folder, figures, footage, pages))


def write_comparison(folder: Path, drawings: Sequence[WipingDrawing]) -> Path | None:
    """Write the figure that compares the wipings of several runs and return its file; None without wipings."""
    if not drawings:
        return None
    figure = make_wiping_figure(drawings)
    with writing_to(folder):
        write_figures(folder, [figure])
    return folder / f"{figure.file}.png"


def _find_footage(result: TaskResult, record: RunRecord, drawn: DrawnRun, reporter: Reporter) -> Footage | None:
    """Return what the film is made from, if it was sampled; report if there can be none."""
    if drawn.film is None or record.truth is None:
        return None
    moments = find_moments(record.wipings, record.history, record.state, record.truth)
    story = make_story(moments, record.history, drawn.library, result, record.state)
    try:
        return drawn.film.footage(story)
    except FilmError as error:
        reporter.say(f"no film: {error}")
        return None
