"""The figure of a search: the path of the tool across the push, the force, and how deep it sank."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from skillc_runtime.evaluation.report.figure_style import (
    DIM,
    INK,
    PAPER,
    WIDTH_IN,
    add_legend,
    plot_curve,
    plot_path,
)
from skillc_runtime.evaluation.report.push_figure import draw_force
from skillc_runtime.evaluation.report.search_drawing import SearchDrawing

HEIGHT_IN = 5.0
LEAST_MM = 1.0
"""At least this much is shown around where a search began."""


def draw_search(drawing: SearchDrawing) -> Figure:
    """Return the figure of a search."""
    figure = Figure(figsize=(WIDTH_IN, HEIGHT_IN), layout="constrained")
    grid = figure.add_gridspec(2, 2, width_ratios=(1.1, 1))
    _draw_path(figure.add_subplot(grid[:, 0]), drawing)
    force = figure.add_subplot(grid[0, 1])
    draw_force(force, drawing.force)
    force.set_title("Force over time")
    force.set_xlabel("")
    _draw_depth(figure.add_subplot(grid[1, 1], sharex=force), drawing)
    add_legend(figure)
    return figure


def _draw_path(axes: Axes, drawing: SearchDrawing) -> None:
    """Draw the path across the push, to scale."""
    search = drawing.search
    path, reference = (search.in_plane(each) for each in (search.samples.position, search.samples.reference))
    plot_path(axes, reference, "commanded", "path", linewidth=0.9)
    plot_path(axes, path, "estimate", "path of the tool", linestyle="-")
    axes.plot(*path[0], "o", color=INK, markeredgecolor=PAPER, markersize=7, zorder=6, label="began")
    if search.found:
        axes.plot(*path[-1], "s", color=INK, markeredgecolor=PAPER, markersize=7, zorder=6, label="gave way")
    if drawing.hole_mm is not None:
        axes.plot(
            *drawing.hole_mm, "x", color=INK, markersize=9, markeredgewidth=2, zorder=7, label="hole: simulator truth"
        )
    holes = [] if drawing.hole_mm is None else [drawing.hole_mm[None]]
    reach = max(LEAST_MM, 1.1 * float(np.abs(np.vstack([path, reference, *holes])).max()))
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal", adjustable="box")
    axes.set(xlabel=f"{search.names[0]}, mm from where it began", ylabel=f"{search.names[1]}, mm")
    axes.set_title("Path of the search, across the push")


def _draw_depth(axes: Axes, drawing: SearchDrawing) -> None:
    """Draw how far the tool has sunk since the search began."""
    search, push = drawing.search, drawing.search.push
    time = push.samples.time
    depth = push.travel_mm - push.travel_mm[min(int(np.searchsorted(time, search.start_s)), len(time) - 1)]
    plot_curve(axes, time - push.start_s, depth, "estimate", "depth", linestyle="-")
    shown = depth[time - push.start_s >= axes.get_xlim()[0]]
    room = 0.08 * max(float(np.ptp(shown)), 1.0)
    axes.set_ylim(shown.min() - room, shown.max() + room)
    when, words = search.end_s - push.start_s, "gave way" if search.found else "search ended"
    axes.axvline(when, color=DIM, linewidth=1.0, linestyle=(0, (6, 3)))
    axes.annotate(
        words,
        (when, 1.0),
        (-4, -10),
        xycoords=("data", "axes fraction"),
        textcoords="offset points",
        ha="right",
        fontsize=8,
    )
    axes.set(xlabel="time from the start of the push, s", ylabel="depth, mm")
    axes.set_title("Depth below where it searched")
