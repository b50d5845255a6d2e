"""The figure of wiping, a row for each surface: path and contact time on it, speed along the lanes, force."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from skillc_runtime.evaluation.report.figure_style import (
    DIM,
    DOSE,
    PAPER,
    SHADE,
    WIDTH_IN,
    add_legend,
    average_over,
    find_force_range,
    mark_outliers,
    plot_curve,
    plot_path,
)
from skillc_runtime.evaluation.report.wiping_drawing import WipingDrawing

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


def draw_figure(drawings: Sequence[WipingDrawing]) -> Figure:
    """Return the figure as a matplotlib object; ValueError if there are no drawings."""
    if not drawings:
        raise ValueError("there is no wiping to draw")
    longest = max(float(drawing.dose.max(initial=0.0)) for drawing in drawings)
    figure = Figure(figsize=(WIDTH_IN, ROW_IN * len(drawings) + LEGEND_IN), layout="constrained")
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
    shades = axes.imshow(
        np.ma.masked_equal(drawing.dose, 0.0), extent=(-x, x, -y, y), origin="lower", cmap=DOSE,
        vmin=0.0, vmax=longest or 1.0, interpolation="nearest", zorder=1,
    )  # fmt: skip
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
        axes.add_patch(Rectangle((-x, -y), 2 * x, 2 * y, label="not wiped", **UNWIPED))
    if spared.any():
        shown, grey = np.ma.masked_equal(spared, False), ListedColormap([SPARED])
        axes.imshow(shown, extent=(-x, x, -y, y), origin="lower", cmap=grey, interpolation="nearest", zorder=0.5)
        axes.add_patch(Rectangle((0, 0), 0, 0, facecolor=SPARED, label="not to be wiped"))


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
    axes.axvspan(drawing.time[0], end, color=SHADE, linewidth=0, zorder=0, label="on the lanes")
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
