"""Writes a task's report, result and figure into a folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec

from skillc_runtime.evaluation.report import page
from skillc_runtime.evaluation.report.figure_files import FigureFiles, NamedFigure, render_figure
from skillc_runtime.evaluation.report.grip_figure import draw_grips
from skillc_runtime.evaluation.report.handling_drawing import HandlingDrawing
from skillc_runtime.evaluation.report.path_figure import draw_path
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.wiping_drawing import WipingDrawing
from skillc_runtime.evaluation.report.wiping_figure import draw_figure
from skillc_runtime.film.film import FilmFiles
from skillc_runtime.recording.node_outcome import NodeOutcome

RESULT, REPORT = "result.json", "report.html"
WIPING, PATH, GRIPS = "wiping", "path", "grips"
"""The names of the figures' files without suffix; a number follows if several hands held something."""


def write_result(directory: Path, result: TaskResult) -> None:
    """Write result.json; OSError if the folder cannot be written to."""
    _write_atomically(directory / RESULT, msgspec.json.format(msgspec.json.encode(result), indent=2) + b"\n")


def write_report(
    directory: Path,
    result: TaskResult,
    trees: Sequence[NodeOutcome],
    drawings: Sequence[WipingDrawing] = (),
    filmed: FilmFiles | None = None,
    handlings: Sequence[HandlingDrawing] = (),
) -> None:
    """Write report.html and the figures; OSError if the folder cannot be written to.

    `trees` are those of all attempts.
    """
    wiping = write_figure(directory, drawings)
    figures: tuple[NamedFigure, ...] = () if wiping is None else (NamedFigure(WIPING, "", wiping),)
    figures += tuple(each for drawing in _number(handlings) for each in _write_handling(directory, *drawing))
    _write_atomically(directory / REPORT, page.render_page(result, trees, figures, filmed).encode())


def write_figure(directory: Path, drawings: Sequence[WipingDrawing]) -> FigureFiles | None:
    """Write the figure of wipings as wiping.png and wiping.svg; return None if there are none.

    OSError if the folder cannot be written to.
    """
    if not drawings:
        return None
    figure = render_figure(lambda: draw_figure(drawings))
    _write_files(directory, WIPING, figure)
    return figure


def _number(handlings: Sequence[HandlingDrawing]) -> list[tuple[HandlingDrawing, str]]:
    """Return drawings with what is added to the names of their files: nothing if there is only one."""
    return [(each, f"-{number}" if len(handlings) > 1 else "") for number, each in enumerate(handlings, 1)]


def _write_handling(directory: Path, drawing: HandlingDrawing, number: str) -> tuple[NamedFigure, ...]:
    """Write the figures of what one hand did."""
    path, grips = render_figure(lambda: draw_path(drawing)), render_figure(lambda: draw_grips(drawing))
    _write_files(directory, PATH + number, path)
    _write_files(directory, GRIPS + number, grips)
    return NamedFigure(PATH, drawing.hand, path), NamedFigure(GRIPS, drawing.hand, grips)


def _write_files(directory: Path, name: str, figure: FigureFiles) -> None:
    _write_atomically(directory / f"{name}.png", figure.png)
    _write_atomically(directory / f"{name}.svg", figure.svg)


def _write_atomically(path: Path, content: bytes) -> None:
    """Write a file atomically."""
    partial = path.with_suffix(path.suffix + ".part")
    try:
        partial.write_bytes(content)
        partial.replace(path)
    except OSError:
        partial.unlink(missing_ok=True)
        raise
