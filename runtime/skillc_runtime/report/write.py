"""Writes a task's report and result into a folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec
import numpy as np

from skillc_runtime.report import page
from skillc_runtime.report.figures import force_figure, path_figure
from skillc_runtime.report.page import Picture
from skillc_runtime.report.result import TaskResult
from skillc_runtime.report.wiping import Wiping, described
from skillc_runtime.simulation.cell import SimulatedCell
from skillc_runtime.simulation.metrics import coverage
from skillc_runtime.task import Execution


def write_report(
    directory: Path, result: TaskResult, execution: Execution, wipings: Sequence[Wiping], film: str | None
) -> None:
    """Write report.html and result.json; OSError when the folder cannot be written to."""
    pictures = [picture for wiping in wipings for picture in pictures_of(wiping, execution.cell)]
    trees = [attempt.tree for attempt in execution.attempts]
    _write(directory / "report.html", page.render(result, trees, pictures, film).encode())
    _write(directory / "result.json", msgspec.json.format(msgspec.json.encode(result), indent=2) + b"\n")


def pictures_of(wiping: Wiping, cell: SimulatedCell) -> list[Picture]:
    """Draw the path with what was wiped, and the force."""
    recording = cell.recording(wiping.tool).between(wiping.began, wiping.end)
    wiped = described(wiping, cell)
    window = recording.between(wiping.start, wiping.end)
    frame = wiped.surface.inverse()
    paths = (
        (np.asarray(points) @ frame.rotation.T + frame.position)[::10, :2]
        for points in (window.reference, window.position)
    )
    path = path_figure(wiped.extent, coverage(window, wiped).dose > 0, *paths)
    force = force_figure(recording.time[::5], recording.force[::5], wiped.force_command_n, (wiping.start, wiping.end))
    name = cell.world.snapshot().vocabulary.short(wiping.surface)
    return [Picture(f"{name}: path and coverage", path), Picture(f"{name}: force", force)]


def _write(path: Path, content: bytes) -> None:
    """Write a file whole or not at all."""
    partial = path.with_suffix(path.suffix + ".part")
    try:
        partial.write_bytes(content)
        partial.replace(path)
    except OSError:
        partial.unlink(missing_ok=True)
        raise
