"""The figure of what inspections have found: a map of dirt for each, with its confidence."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import msgspec
import numpy as np

from skillc_runtime.evaluation.report.plotting import DIM, PAPER, add_legend, draw_outline, start_figure
from skillc_runtime.evaluation.report.run_record import RunRecord
from skillc_runtime.motion.dirt_map import CLEAN, DIRTY, SPARED, DirtMap
from skillc_runtime.motion.pose import Array
from skillc_runtime.recording.history.history import RecordedCall
from skillc_runtime.world.space.frames import size
from skillc_runtime.world.state.labels.dirt_text import written_dirt_map
from skillc_runtime.world.state.labels.labelled import LabelledProperty, display_name

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = {CLEAN: "#2a9d8f", DIRTY: "#8a6d3b", SPARED: "#b9c0c8"}
"""The colours of cells in a map that is certain."""

NAMES = {CLEAN: "clean", DIRTY: "dirty", SPARED: "not to be worked on"}

COLUMNS, ROW_IN = 3, 3.6
"""How many maps are side by side, and how high they are."""

MOST_MAPS = 12
"""The first so many maps are drawn."""


class FoundMap(msgspec.Struct, frozen=True):
    """A map that a call found at a time in s, and how; size (2,): of the surface in mm."""

    surface: str
    call: str
    known: str
    time: float
    dirt: DirtMap
    size: Array


def find_maps(record: RunRecord) -> tuple[FoundMap, ...]:
    """Return the maps of dirt that were found in a run, in the order of time."""
    found = (each for call in record.history.calls for each in _find_in(call, record))
    return tuple(sorted(found, key=lambda each: each.time))[:MOST_MAPS]


def _find_in(call: RecordedCall, record: RunRecord) -> Iterator[FoundMap]:
    for each in call.found:
        dirt = written_dirt_map(each.fact)
        if dirt is not None and isinstance(each.fact, LabelledProperty) and each.since is not None:
            surface = each.fact.individual.iri
            extent = 1e3 * size(record.state, surface)[:2]
            yield FoundMap(display_name(surface), f"{call.number} {call.skill}", each.known, each.since, dirt, extent)


def draw_maps(maps: Sequence[FoundMap]) -> Figure:
    """Return the figure: a cell is the paler, the less certain it is; what was not seen is hatched."""
    rows = -(-len(maps) // COLUMNS)
    figure = start_figure(ROW_IN * rows + 0.5)
    grid = figure.add_gridspec(rows, min(COLUMNS, max(2, len(maps))))
    for number, each in enumerate(maps):
        _draw_map(figure.add_subplot(grid[number // COLUMNS, number % COLUMNS]), each)
    add_legend(figure)
    return figure


def _draw_map(axes: Axes, found: FoundMap) -> None:
    from matplotlib.colors import to_rgb

    dirt, (x, y) = found.dirt, found.size / 2
    shape = dirt.rows, dirt.columns
    state, sure = (np.frombuffer(each, dtype=np.uint8).reshape(shape) for each in (dirt.state, dirt.confidence))
    pixels = np.zeros((*shape, 4))
    for kind, colour in COLOURS.items():
        pixels[state == kind, :3] = to_rgb(colour)
        if (state == kind).any():
            draw_outline(axes, np.zeros((1, 2)), NAMES[kind], facecolor=colour)
    certain = np.where(state == SPARED, 10, sure) / 10.0
    strength = np.clip(2.0 * certain - 1.0, 0.15, 1.0)[..., None]
    pixels[..., :3] = strength * pixels[..., :3] + 1.0 - strength
    pixels[..., 3] = np.isin(state, list(COLOURS))
    corners = np.array([(-x, -y), (x, -y), (x, y), (-x, y)])
    draw_outline(axes, corners, "not seen", facecolor=PAPER, edgecolor=DIM, hatch="////", linewidth=0.6, zorder=0)
    axes.imshow(pixels, extent=(-x, x, -y, y), origin="lower", interpolation="nearest", zorder=1)
    axes.set(xlabel="x, mm", ylabel="y, mm", aspect="equal")
    axes.grid(visible=False)
    axes.set_title(
        f"{found.call}, {found.time:.1f} s, {found.known}\n{found.surface}: {dirt.clean_share:.1%} clean, "
        f"{dirt.dirty_share:.1%} dirty",
        fontsize=8,
    )
