"""The figures of pressed tools: wiping with a row for each surface, a push, and a search."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from skillc_runtime.evaluation.report.plotting import (
    DIM,
    DOSE,
    PAPER,
    add_legend,
    draw_band,
    draw_map,
    draw_outline,
    mark_outliers,
    plot_curve,
    plot_path,
    start_figure,
)
from skillc_runtime.evaluation.report.wiping import WipingDrawing
from skillc_runtime.motion.pose import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

from typing import TYPE_CHECKING

from skillc_runtime.evaluation.report.plotting import (
    BROKEN,
    mark_place,
)
from skillc_runtime.evaluation.report.pushes import PushDrawing
from skillc_runtime.evaluation.report.searches import SearchDrawing

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

BEFORE_CONTACT_S = 1.0
"""How much of the approach is shown."""

MARGIN_MM = 10.0
"""How much is shown around a surface."""

UNWIPED: dict[str, Any] = {"facecolor": PAPER, "edgecolor": DIM, "hatch": "////", "linewidth": 0.0, "zorder": 0}

SPARED = "#b9c0c8"
"""The colour of what is not to be wiped."""

SEEN_DIRTY = "#8a6d3b"
"""The colour of what the last inspection showed dirty."""

LANES: dict[str, Any] = {"linestyle": "-", "linewidth": 0.9}
"""A commanded path is dense where it turns: dots would not be seen."""

ROW_IN, LEGEND_IN, PUSH_IN, SEARCH_IN = 4.4, 0.6, 3.9, 5.0
"""Heights of what is drawn of one surface, of the legend below, and of the figures of a push and of a search."""

BEFORE_S = 0.5
"""How much of the approach is shown."""

ROOM = 1.08
"""The force axis ends above the greatest force by this factor."""

LEAST_MM = 1.0
"""At least this much is shown around where a search began."""


def draw_wipings(drawings: Sequence[WipingDrawing]) -> Figure:
    """Return the figure of wipings; ValueError if there are no drawings."""
    if not drawings:
        raise ValueError("there is no wiping to draw")
    longest = max(float(drawing.dose.max(initial=0.0)) for drawing in drawings)
    figure = start_figure(ROW_IN * len(drawings) + LEGEND_IN)
    grid = figure.add_gridspec(2 * len(drawings), 2, width_ratios=(1.15, 1))
    for number, drawing in enumerate(drawings):
        upper, lower = 2 * number, 2 * number + 1
        cells = (grid[upper : lower + 1, 0], grid[upper, 1], grid[lower, 1])
        surface, speed, force = (figure.add_subplot(each) for each in cells)
        _draw_surface(surface, drawing, longest)
        _draw_speed(speed, drawing)
        _draw_normal_force(force, drawing)
    add_legend(figure)
    return figure


def _draw_surface(axes: Axes, drawing: WipingDrawing, longest: float) -> None:
    """Shade the contact time of each cell and draw both paths over it; x of every surface lies across."""
    x, y = drawing.extent / 2
    shades = draw_map(axes, drawing.dose, drawing.extent / 2, DOSE, longest or 1.0)
    _draw_unwiped(axes, drawing)
    plot_path(axes, drawing.tool, "truth", "tool")
    plot_path(axes, drawing.lanes, "commanded", "lanes, without overlay", **LANES)
    axes.set(xlabel="x on the surface, mm", ylabel="y on the surface, mm", aspect="equal")
    axes.set(xlim=(-x - MARGIN_MM, x + MARGIN_MM), ylim=(-y - MARGIN_MM, y + MARGIN_MM))
    axes.grid(visible=False)
    done = f"clean, {drawing.before:.1%} before" if drawing.before else "wiped"
    axes.set_title(f"{drawing.surface} by {drawing.robot}: {drawing.covered:.1%} {done}")
    axes.figure.colorbar(shades, ax=axes, label="contact time of a 5 mm cell, s", shrink=0.8, pad=0.02)


def _draw_unwiped(axes: Axes, drawing: WipingDrawing) -> None:
    """Draw the cells that were not wiped, those that need not be, and those seen dirty in the end, if there are any."""
    x, y = drawing.extent / 2
    unwiped = drawing.dose == 0.0
    spared = np.zeros_like(unwiped) if drawing.spared is None else drawing.spared & unwiped
    if (unwiped & ~spared).any():
        draw_outline(axes, np.array([(-x, -y), (x, -y), (x, y), (-x, y)]), "not wiped", **UNWIPED)
    if spared.any():
        draw_map(axes, spared, drawing.extent / 2, (SPARED,), 1.0, zorder=0.5)
        draw_outline(axes, np.zeros((1, 2)), "not to be wiped", facecolor=SPARED)
    if drawing.seen_dirty is not None and drawing.seen_dirty.any():
        draw_map(axes, drawing.seen_dirty.astype(np.float64), drawing.extent / 2, (SEEN_DIRTY,), 1.0, zorder=1.5)
        draw_outline(axes, np.zeros((1, 2)), "seen dirty in the end", facecolor=SEEN_DIRTY)


def _draw_speed(axes: Axes, drawing: WipingDrawing) -> None:
    """Draw the speed of the tool along the lanes, averaged over a period of the overlay if there is one."""
    _mark_pauses(axes, drawing)
    period_s = drawing.overlay_period_s
    if period_s is None:
        plot_curve(axes, drawing.time, drawing.tool_speed, "truth", "tool")
        axes.set_title("Speed along the lanes")
    else:
        plot_curve(axes, drawing.time, drawing.tool_speed, "truth", "tool with its overlay", linewidth=0.5, alpha=0.5)
        mean = _average_over(drawing.tool_speed, period_s / drawing.step_s)
        plot_curve(axes, drawing.time, mean, "truth", "mean over a period of the overlay", linewidth=1.8)
        axes.set_title(f"Speed along the lanes, overlay of {period_s:.2f} s")
    plot_curve(axes, drawing.time, drawing.lane_speed, "commanded", "lanes, without overlay", **LANES)
    dwell = "half the lane speed"
    axes.axhline(drawing.dwell_speed, color=DIM, linewidth=0.9, linestyle=(0, (5, 3)), label=dwell)
    axes.set(xlabel="time from the first lane, s", ylabel="speed, mm/s")


def _draw_normal_force(axes: Axes, drawing: WipingDrawing) -> None:
    """Draw the normal force, from shortly before contact; the band of the force on the lanes fills the height."""
    end = drawing.time[-1]
    contacts = drawing.contact_time[drawing.force > 0]
    first = float(contacts[0] if contacts.size else drawing.contact_time[0]) - BEFORE_CONTACT_S
    draw_band(axes, drawing.time[0], end, "on the lanes")
    _mark_pauses(axes, drawing)
    plot_curve(axes, drawing.contact_time, drawing.force, "truth", "normal force", linewidth=0.7)
    plot_curve(axes, np.array([first, end]), np.full(2, drawing.force_n), "commanded", "force")
    low, high = _find_force_range(drawing.force[drawing.contact_time >= 0.0], drawing.force_n)
    axes.set(xlabel="time from the first lane, s", ylabel="normal force, N", xlim=(first, end), ylim=(low, high))
    axes.set_title(f"Force on the surface, {drawing.force_n:g} N commanded")
    mark_outliers(axes, drawing.contact_time, drawing.force)


def _mark_pauses(axes: Axes, drawing: WipingDrawing) -> None:
    for start, end in drawing.pauses:
        axes.axvspan(start, end, facecolor="none", edgecolor=DIM, hatch="////", linewidth=0.5, label="paused")


def _find_force_range(force_n: Array, commanded_n: float | None) -> tuple[float, float]:
    """Return the limits in N of an axis on which the band of interest fills most of the height.

    They enclose all but the outermost percent of the forces (n,), and the commanded force with a tenth of it around.
    """
    known = force_n[np.isfinite(force_n)]
    low, high = np.percentile(known, (0.5, 99.5)) if known.size else (0.0, 1.0)
    if commanded_n is not None:
        low, high = min(low, 0.9 * commanded_n), max(high, 1.1 * commanded_n)
    room = 0.15 * max(high - low, 0.1)
    return float(low - room), float(high + room)


def _average_over(values: Array, width: float) -> Array:
    """Return the moving mean of values (n,) over `width` samples; NaN where a value of it is none."""
    count = max(1, min(round(width), len(values)))
    weights = np.ones(count) / count
    inside = np.convolve(np.ones(len(values)), weights, mode="same")
    return np.asarray(np.convolve(values, weights, mode="same") / inside)


def draw_push(drawing: PushDrawing) -> Figure:
    """Return the figure of a push."""
    figure = start_figure(PUSH_IN)
    by_time, by_travel = figure.subplots(1, 2, sharey=True)
    push, time, travel = drawing.push, drawing.push.samples.time, drawing.push.travel_mm
    _draw_push_force(by_time, drawing)
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
    _draw_push_force(force, drawing.force)
    force.set_xlabel("")
    _draw_depth(figure.add_subplot(grid[1, 1], sharex=force), drawing)
    add_legend(figure)
    return figure


def _draw_push_force(axes: Axes, drawing: PushDrawing) -> None:
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
