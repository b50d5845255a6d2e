"""Writes a task's report, result and figures into a folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec
from msgspec.structs import replace

from skillc_runtime.evaluation.report.figure import DrawnFigure, WorkFigure, number_files, render_figure
from skillc_runtime.evaluation.report.result import REPORT, RESULT, TaskResult
from skillc_runtime.recording.history.node_outcome import NodeOutcome

if TYPE_CHECKING:
    from skillc_runtime.film.footage import FilmFiles


def write_result(directory: Path, result: TaskResult) -> None:
    """Write result.json; OSError if the folder cannot be written to."""
    _write_atomically(directory / RESULT, msgspec.json.format(msgspec.json.encode(result), indent=2) + b"\n")


def write_report(
    directory: Path, result: TaskResult, trees: Sequence[NodeOutcome], figures: Sequence[WorkFigure] = ()
) -> None:
    """Write report.html without a film, and the figures; OSError if the folder cannot be written to.

    `trees` are those of all attempts.
    """
    write_page(directory, ReportPages(result, trees, write_figures(directory, number_files(figures))).without_film)


def write_page(directory: Path, page: str) -> None:
    """Write report.html; OSError if the folder cannot be written to."""
    _write_atomically(directory / REPORT, page.encode())


def read_page(directory: Path) -> str | None:
    """Return report.html; None if it is not there."""
    try:
        return (directory / REPORT).read_text(encoding="utf-8")
    except FileNotFoundError:
        return None


def write_figures(directory: Path, figures: Sequence[WorkFigure]) -> tuple[DrawnFigure, ...]:
    """Write figures, whose files have names of their own, as PNG and SVG; return them.

    OSError if the folder cannot be written to.
    """
    drawn = []
    for each in figures:
        files = render_figure(each.draw)
        _write_atomically(directory / f"{each.file}.png", files.png)
        _write_atomically(directory / f"{each.file}.svg", files.svg)
        drawn.append(DrawnFigure(each, files))
    return tuple(drawn)


class ReportPages(msgspec.Struct, frozen=True):
    """The page of a report while its pictures are made and afterwards; `trees` are those of all attempts.

    `film` are the files of the film, if there is to be one.
    """

    result: TaskResult
    trees: Sequence[NodeOutcome]
    figures: Sequence[DrawnFigure] = ()
    film: FilmFiles | None = None

    @property
    def begun(self) -> str:
        """The page while the film and figures that are not drawn are being made."""
        return self._render(is_made=False)

    @property
    def with_film(self) -> str:
        """The page when the film has been made."""
        return self._render(is_made=True)

    @property
    def without_film(self) -> str:
        """The page without a film, and without figures that are not drawn."""
        drawn = [each for each in self.figures if each.files is not None]
        return replace(self, film=None, figures=drawn).with_film

    def with_figures(self, drawn: Sequence[DrawnFigure]) -> ReportPages:
        """Return the pages with figures that are drawn."""
        return replace(self, figures=drawn)

    def _render(self, is_made: bool) -> str:
        from skillc_runtime.evaluation.report.page import render_page

        return render_page(self.result, self.trees, self.figures, self.film, is_made)


def _write_atomically(path: Path, content: bytes) -> None:
    """Write a file atomically."""
    partial = path.with_suffix(path.suffix + ".part")
    try:
        partial.write_bytes(content)
        partial.replace(path)
    except BaseException:
        partial.unlink(missing_ok=True)
        raise
