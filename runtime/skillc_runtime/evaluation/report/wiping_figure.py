"""The figure of wiping, a row for each surface: path and contact time on it, speed along the lanes, force."""

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

ROW_IN, LEGEND_IN = 4.4, 0.6
"""Heights of what is drawn of one surface, and of the legend."""

BEFORE_CONTACT_S = 1.0
"""How much of the approach is shown."""

MARGIN_MM = 10.0
"""How much is shown around a surface."""

UNWIPED: dict[str, Any] = {"facecolor": PAPER, "edgecolor": DIM, "hatch": "////", "linewidth": 0.0, "zorder": 0}

SPARED = "#b9c0c8"
"""The colour of what is not to be wiped."""

LANES: dict[str, Any] = {"linestyle": "-", "linewidth": 0.9}
"""A commanded path is dense where it turns: dots would not be seen."""


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
        _draw_force(force, drawing)
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
    axes.set_title(f"{drawing.surface} by {drawing.robot}: {drawing.covered:.1%} wiped")
    axes.figure.colorbar(shades, ax=axes, label="contact time of a 5 mm cell, s", shrink=0.8, pad=0.02)


def _draw_unwiped(axes: Axes, drawing: WipingDrawing) -> None:
    """Draw the cells that were not wiped, and those that should not be, if there are any."""
    x, y = drawing.extent / 2
    unwiped = drawing.dose == 0.0
    spared = np.zeros_like(unwiped) if drawing.spared is None else drawing.spared & unwiped
    if (unwiped & ~spared).any():
        draw_outline(axes, np.array([(-x, -y), (x, -y), (x, y), (-x, y)]), "not wiped", **UNWIPED)
    if spared.any():
        draw_map(axes, spared, drawing.extent / 2, (SPARED,), 1.0, zorder=0.5)
        draw_outline(axes, np.zeros((1, 2)), "not to be wiped", facecolor=SPARED)


def _draw_speed(axes: Axes, drawing: WipingDrawing) -> None:
    """Draw the speed of the tool along the lanes, averaged over a period of the overlay if there is one."""
    _mark_pauses(axes, drawing)
    period_s = drawing.overlay_period_s
    if period_s is None:
        plot_curve(axes, drawing.time, drawing.tool_speed, "truth", "tool")
        axes.set_title("Speed along the lanes")
    else:
        plot_curve(axes, drawing.time, drawing.tool_speed, "truth", "tool with its overlay", linewidth=0.5, alpha=0.5)
        mean = average_over(drawing.tool_speed, period_s / drawing.step_s)
        plot_curve(axes, drawing.time, mean, "truth", "mean over a period of the overlay", linewidth=1.8)
        axes.set_title(f"Speed along the lanes, overlay of {period_s:.2f} s")
    plot_curve(axes, drawing.time, drawing.lane_speed, "commanded", "lanes, without overlay", **LANES)
    dwell = "half the lane speed"
    axes.axhline(drawing.dwell_speed, color=DIM, linewidth=0.9, linestyle=(0, (5, 3)), label=dwell)
    axes.set(xlabel="time from the first lane, s", ylabel="speed, mm/s")


def _draw_force(axes: Axes, drawing: WipingDrawing) -> None:
    """Draw the normal force, from shortly before contact; the band of the force on the lanes fills the height."""
    end = drawing.time[-1]
    contacts = drawing.contact_time[drawing.force > 0]
    first = float(contacts[0] if contacts.size else drawing.contact_time[0]) - BEFORE_CONTACT_S
    draw_band(axes, drawing.time[0], end, "on the lanes")
    _mark_pauses(axes, drawing)
    plot_curve(axes, drawing.contact_time, drawing.force, "truth", "normal force", linewidth=0.7)
    plot_curve(axes, np.array([first, end]), np.full(2, drawing.force_n), "commanded", "force")
    low, high = find_force_range(drawing.force[drawing.contact_time >= 0.0], drawing.force_n)
    axes.set(xlabel="time from the first lane, s", ylabel="normal force, N", xlim=(first, end), ylim=(low, high))
    axes.set_title(f"Force on the surface, {drawing.force_n:g} N commanded")
    mark_outliers(axes, drawing.contact_time, drawing.force)


def _mark_pauses(axes: Axes, drawing: WipingDrawing) -> None:
    for start, end in drawing.pauses:
        axes.axvspan(start, end, facecolor="none", edgecolor=DIM, hatch="////", linewidth=0.5, label="paused")


def find_force_range(force_n: Array, commanded_n: float | None) -> tuple[float, float]:
    """Return the limits in N of an axis on which the band of interest fills most of the height.

    They enclose all but the outermost percent of the forces (n,), and the commanded force with a tenth of it around.
    """
    known = force_n[np.isfinite(force_n)]
    low, high = np.percentile(known, (0.5, 99.5)) if known.size else (0.0, 1.0)
    if commanded_n is not None:
        low, high = min(low, 0.9 * commanded_n), max(high, 1.1 * commanded_n)
    room = 0.15 * max(high - low, 0.1)
    return float(low - room), float(high + room)


def average_over(values: Array, width: float) -> Array:
    """Return the moving mean of values (n,) over `width` samples; NaN where a value of it is none."""
    count = max(1, min(round(width), len(values)))
    weights = np.ones(count) / count
    inside = np.convolve(np.ones(len(values)), weights, mode="same")
    return np.asarray(np.convolve(values, weights, mode="same") / inside)
