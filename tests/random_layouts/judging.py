"""Judges what a look in space says of putting a part into a bin, or of wiping a surface among things."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from judged_looks.looking import judge_task
from judged_looks.verdict import Verdict
from random_cells.writing import TASK, write_cell
from random_layouts.drawing import Layout, draw_layout, format_layout
from random_layouts.exhaustive import find_way
from random_surfaces.drawing import draw_crowded_surface
from random_surfaces.judging import judge_surface
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.tasks.loading import load_task
from skillc_runtime.recording.run_spec import RunSpec

TILTED: Final = "tilted"
"""The kind of layouts with a surface that is to be wiped and things around it."""

HANDLING, DRIVING = 'import "handling.skill"\n', 'import "driving.skill"\n'


def write_layout(layout: Layout, folder: Path) -> str:
    """Write the library and the scene of a layout into a folder; return the name of its task."""
    write_cell(layout.cell, folder)
    if layout.stations:
        skill = folder / f"{folder.name}.skill"
        skill.write_text(skill.read_text("utf-8").replace(HANDLING, HANDLING + DRIVING), "utf-8")
    (folder / "cell.ttl").write_text(format_layout(layout, folder.name), "utf-8")
    return f"{folder}:{TASK}"


def judge(seed: int, kind: str, folder: Path) -> Verdict:
    """Judge what is said of the layout of a seed and a kind; it is written into a folder."""
    if kind == TILTED:
        return judge_surface(draw_crowded_surface(seed), seed, kind, folder)
    layout = draw_layout(seed, kind)
    name = write_layout(layout, folder / f"{kind.replace('-', '_')}_{seed}")
    with load_task(RunSpec(task=name), SilentReporter()) as task:
        return judge_task(task, seed, kind, lambda cell: find_way(cell, layout))
