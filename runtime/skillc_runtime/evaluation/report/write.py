"""Writes a task's report, result and figure into a folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.evaluation.report import page
from skillc_runtime.evaluation.report.drawing import Drawing
from skillc_runtime.evaluation.report.figures import FigureFiles, render_figure
from skillc_runtime.evaluation.report.result import TaskResult
from skillc_runtime.execution.task_run import Execution
from skillc_runtime.film.film import FilmFiles

FIGURE = "wiping"
"""Name of the figure's files, but for their ending."""


def write_report(
    directory: Path,
    result: TaskResult,
    execution: Execution[SimulatedCell],
    drawings: Sequence[Drawing],
    filmed: FilmFiles | None,
) -> None:
    """Write report.html and result.json, and the figure of what was wiped; OSError where the folder refuses."""
    figure = write_figure(directory, drawings)
    trees = [attempt.tree for attempt in execution.attempts]
    _write(directory / "report.html", page.render(result, trees, figure, filmed).encode())
    _write(directory / "result.json", msgspec.json.format(msgspec.json.encode(result), indent=2) + b"\n")


def write_figure(directory: Path, drawings: Sequence[Drawing]) -> FigureFiles | None:
    """Write the figure of wipings side by side as wiping.png and wiping.svg; nothing where nothing was wiped.

    OSError where the folder cannot be written to.
    """
    if not drawings:
        return None
    figure = render_figure(drawings)
    _write(directory / f"{FIGURE}.png", figure.png)
    _write(directory / f"{FIGURE}.svg", figure.svg)
    return figure


def _write(path: Path, content: bytes) -> None:
    """Write a file whole or not at all."""
    partial = path.with_suffix(path.suffix + ".part")
    try:
        partial.write_bytes(content)
        partial.replace(path)
    except OSError:
        partial.unlink(missing_ok=True)
        raise
