"""Writes a task's report, result and figure into a folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import msgspec

from skillc_runtime.evaluation.report import page
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.evaluation.report.wiping_drawing import WipingDrawing
from skillc_runtime.evaluation.report.wiping_figure import FigureFiles, render_figure
from skillc_runtime.execution.execute import Execution
from skillc_runtime.film.film import FilmFiles

FIGURE = "wiping"
"""The name of the figure's files without suffix."""


def write_report(
    directory: Path,
    result: TaskResult,
    execution: Execution[Any],
    drawings: Sequence[WipingDrawing],
    filmed: FilmFiles | None,
) -> None:
    """Write report.html, result.json and the figure of wiping; OSError if the folder cannot be written to."""
    figure = write_figure(directory, drawings)
    trees = [attempt.tree for attempt in execution.attempts]
    _write_atomically(directory / "report.html", page.render_page(result, trees, figure, filmed).encode())
    _write_atomically(directory / "result.json", msgspec.json.format(msgspec.json.encode(result), indent=2) + b"\n")


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
