"""Writes the result of a run with its report, figures, film and stills into a folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from skillc.services.files import writing_to
from skillc.services.reporting import Reporter
from skillc_model.skills import SkillLibrary
from skillc_runtime.evaluation.report.film_story import make_story
from skillc_runtime.evaluation.report.moments import find_moments
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.run_record import RunRecord
from skillc_runtime.evaluation.report.wiping_drawing import WipingDrawing
from skillc_runtime.evaluation.report.work_figures import list_figures
from skillc_runtime.evaluation.report.write import write_figure, write_report, write_result
from skillc_runtime.film.film import Film, FilmFiles, Story
from skillc_runtime.film.picture_files import FilmError
from skillc_runtime.film.rendering import RenderingError
from skillc_runtime.recording.node_outcome import NodeOutcome


def write_run(
    folder: Path,
    result: TaskResult,
    record: RunRecord,
    trees: Sequence[NodeOutcome],
    library: SkillLibrary,
    film: Film | None,
    reporter: Reporter,
) -> None:
    """Write a run with its trees, and its film if it was sampled. ServiceError if the folder cannot be written to."""
    with writing_to(folder):
        write_result(folder, result)
        filmed = None
        if film is not None and record.truth is not None:
            moments = find_moments(record.wipings, record.history, record.state, record.truth)
            story = make_story(moments, record.history, library, result, record.state)
            filmed = _write_film(film, folder, story, reporter)
        write_report(folder, result, trees, list_figures(record), filmed)


def write_comparison(folder: Path, drawings: Sequence[WipingDrawing]) -> Path | None:
    """Write the figure that compares the wipings of several runs and return its file; None without wipings."""
    with writing_to(folder):
        return folder / "wiping.png" if write_figure(folder, drawings) is not None else None


def _write_film(film: Film, folder: Path, story: Story, reporter: Reporter) -> FilmFiles | None:
    """Write the film, stills and the loop if it is wanted; report if they cannot be made."""
    try:
        return film.write(folder, story)
    except (FilmError, RenderingError) as error:
        reporter.say(f"no film: {error}")
        return None
