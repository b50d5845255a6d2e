"""Writes a task's report, result and figure into a folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec

from skillc_runtime.evaluation.report import page
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.wiping_drawing import WipingDrawing
from skillc_runtime.evaluation.report.wiping_figure import FigureFiles, render_figure
from skillc_runtime.film.film import FilmFiles
from skillc_runtime.recording.node_outcome import NodeOutcome

RESULT, REPORT = "result.json", "report.html"
FIGURE = "wiping"
"""The name of the figure's files without suffix."""


def write_result(directory: Path, result: TaskResult) -> None:
    """Write result.json; OSError if the folder cannot be written to."""
    _write_atomically(directory / RESULT, msgspec.json.format(msgspec.json.encode(result), indent=2) + b"\n")


def write_report(
    directory: Path,
    result: TaskResult,
    trees: Sequence[NodeOutcome],
    drawings: Sequence[WipingDrawing] = (),
    filmed: FilmFiles | None = None,
) -> None:
    """Write report.html and the figure of wiping; OSError if the folder cannot be written to.

    `trees` are those of all attempts.
    """
    figure = write_figure(directory, drawings)
    _write_atomically(directory / REPORT, page.render_page(result, trees, figure, filmed).encode())


def write_figure(directory: Path, drawings: Sequence[WipingDrawing]) -> FigureFiles | None:
    """Write the figure of wipings as wiping.png and wiping.svg; return None if there are none.

    OSError if the folder cannot be written to.
    """
    if not drawings:
        return None
    figure = render_figure(drawings)
    _write_atomically(directory / f"{FIGURE}.png", figure.png)
    _write_atomically(directory / f"{FIGURE}.svg", figure.svg)
    return figure


def _write_atomically(path: Path, content: bytes) -> None:
    """Write a file atomically."""
    partial = path.with_suffix(path.suffix + ".part")
    try:
        partial.write_bytes(content)
        partial.replace(path)
    except OSError:
        partial.unlink(missing_ok=True)
        raise
