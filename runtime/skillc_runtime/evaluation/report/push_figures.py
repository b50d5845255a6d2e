"""The figures of a push and of a search with a pressed tool: force over time and travel, path and depth."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.evaluation.report.plotting import (
    BROKEN,
    add_legend,
    draw_band,
    mark_place,
    plot_curve,
    plot_path,
    start_figure,
)
from skillc_runtime.evaluation.report.pushes import PushDrawing
from skillc_runtime.evaluation.report.searches import SearchDrawing
from skillc_runtime.motion.pose import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PUSH_IN, SEARCH_IN = 3.9, 5.0
"""The heights of the figures."""

BEFORE_S = 0.5
"""How much of the approach is shown."""

ROOM = 1.08
"""The force axis ends above the greatest force by this factor."""

LEAST_MM = 1.0
"""At least this much is shown around where a search began."""


def draw_push(drawing: PushDrawing) -> Figure:
    """Return the figure of a push."""
    figure = start_figure(PUSH_IN)
    by_time, by_travel = figure.subplots(1, 2, sharey=True)
    push, time, travel = drawing.push, drawing.push.samples.time, drawing.push.travel_mm
    _draw_force(by_time, drawing)
    moved = time >= (push.start_s if push.contact_s is None else push.contact_s)
    if push.truth is not None:
        at = np.interp(push.truth[:, 0], time, travel)
        plot_curve(by_travel, at, push.truth[:, 1], "truth", "force")
    plot_curve(by_travel, travel[moved], push.force[moved], drawing.source, "force")
    plot_curve(by_travel, _ends(travel[moved]), np.full(2, push.force_n), "commanded", "force")
    by_travel.set(xlabel=f"travel of the tool after {'contact' if push.contact_s else 'its start'}, mm: estimate")
    by_travel.set_title("Force over travel")
    by_travel.tick_params(labelleft=True)
    add_legend(figure)
    return figure


def draw_search(drawing: SearchDrawing) -> Figure:
    """Return the figure of a search."""
    figure = start_figure(SEARCH_IN)
    grid = figure.add_gridspec(2, 2, width_ratios=(1.1, 1))
    _draw_path(figure.add_subplot(grid[:, 0]), drawing)
    force = figure.add_subplot(grid[0, 1])
    _draw_force(force, drawing.force)
    force.set_xlabel("")
    _draw_depth(figure.add_subplot(grid[1, 1], sharex=force), drawing)
    add_legend(figure)
    return figure


def _draw_force(axes: Axes, drawing: PushDrawing) -> None:
    """Draw the force of a push over time, all that is known of it."""
    push, time = drawing.push, drawing.push.samples.time - drawing.push.start_s
    if push.contact_s is not None:
        draw_band(axes, push.contact_s - push.start_s, time[-1], "in contact")
    if push.truth is not None:
        plot_curve(axes, push.truth[:, 0] - push.start_s, push.truth[:, 1], "truth", "force")
    plot_curve(axes, time, push.force, drawing.source, "force")
    plot_curve(axes, _ends(time), np.full(2, push.force_n), "commanded", "force")
    if drawing.switched_s is not None:
        axes.axvline(drawing.switched_s - push.start_s, label="switched: simulator truth", **BROKEN)
    every = np.concatenate([push.force, *([] if push.truth is None else [push.truth[:, 1]])])
    first = time[0] if push.contact_s is None else max(time[0], push.contact_s - push.start_s - BEFORE_S)
    axes.set(xlabel="time from the start of the push, s", ylabel="force, N", xlim=(first, time[-1]))
    axes.set_ylim(min(every.min(), 0.0) - 0.05 * push.force_n, ROOM * max(every.max(), push.force_n))
    axes.set_title("Force over time")


def _draw_path(axes: Axes, drawing: SearchDrawing) -> None:
    """Draw the path across the push, to scale."""
    search = drawing.search
    path, reference = (search.in_plane(each) for each in (search.samples.position, search.samples.reference))
    plot_path(axes, reference, "commanded", "path", linewidth=0.9)
    plot_path(axes, path, "estimate", "path of the tool", linestyle="-")
    mark_place(axes, path[0], "began", "began")
    if search.found:
        mark_place(axes, path[-1], "ended", "gave way")
    holes = [] if drawing.hole_mm is None else [drawing.hole_mm]
    for hole in holes:
        mark_place(axes, hole, "marked", "hole: simulator truth")
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
    axes.axvline(when, **BROKEN)
    axes.annotate(
        words, (when, 1.0), (-4, -10), xycoords=("data", "axes fraction"), textcoords="offset points", ha="right",
        fontsize=8,
    )  # fmt: skip
    axes.set(xlabel="time from the start of the push, s", ylabel="depth, mm")
    axes.set_title("Depth below where it searched")


def _ends(values: Array) -> Array:
    return np.array([values.min(initial=0.0), values.max(initial=0.0)])
