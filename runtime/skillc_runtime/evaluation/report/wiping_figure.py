"""The figure of wiping, a column for each surface: path and contact time on it, speed along the lanes, force."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from skillc_runtime.evaluation.report.wiping_drawing import WipingDrawing

LANES, TOOL, TARGET, WIPING, PAUSED = "#000000", "#d55e00", "#0072b2", "#e8e8e8", "#808080"
"""Colours that people with colour blindness can distinguish; they also differ in lightness."""

UNWIPED, DOSE, DOSE_ALPHA = "#ffffff", "cividis_r", 0.7
COLUMN_IN, HEIGHT_IN = 6.2, 8.6

COMPACT: Mapping[str, float] = {"handlelength": 1.5, "columnspacing": 1.2}

BEFORE_CONTACT_S = 1.0
"""How much of the approach is shown."""

MARGIN_MM = 10.0
"""How much is shown around a surface."""


def draw_figure(drawings: Sequence[WipingDrawing]) -> Figure:
    """Return the figure as a matplotlib object; ValueError if there are no drawings."""
    if not drawings:
        raise ValueError("there is no wiping to draw")
    longest = max(float(drawing.dose.max(initial=0.0)) for drawing in drawings)
    figure = Figure(figsize=(COLUMN_IN * len(drawings), HEIGHT_IN), layout="constrained")
    columns = figure.subplots(3, len(drawings), squeeze=False, height_ratios=(2.6, 1, 1)).T
    for drawing, (surface, speed, force) in zip(drawings, columns, strict=True):
        _draw_surface(surface, drawing, longest)
        _draw_speed(speed, drawing)
        _draw_force(force, drawing)
    return figure


def _draw_surface(axes: Axes, drawing: WipingDrawing, longest: float) -> None:
    """Shade the contact time of each cell and draw both paths over it, with the longer side horizontal."""
    upright = drawing.extent[1] > drawing.extent[0]
    order, names = ((1, 0), "yx") if upright else ((0, 1), "xy")
    x, y = drawing.extent[list(order)] / 2
    shades = axes.imshow(
        np.ma.masked_equal(drawing.dose.T if upright else drawing.dose, 0.0),
        extent=(-x, x, -y, y),
        origin="lower",
        cmap=mpl.colormaps[DOSE].with_extremes(bad=UNWIPED),
        alpha=DOSE_ALPHA,
        vmin=0.0,
        vmax=longest,
    )
    for path, colour, width, label in (
        (drawing.tool, TOOL, 0.8, "tool"),
        (drawing.lanes, LANES, 1.2, "commanded lanes"),
    ):
        axes.plot(*path.T[list(order)], color=colour, linewidth=width, label=label)
    axes.plot([], [], color=UNWIPED, marker="s", markeredgecolor=LANES, linestyle="", label="not wiped")
    axes.set(xlabel=f"{names[0]} on the surface, mm", ylabel=f"{names[1]} on the surface, mm", aspect="equal")
    axes.set(xlim=(-x - MARGIN_MM, x + MARGIN_MM), ylim=(-y - MARGIN_MM, y + MARGIN_MM))
    _set_title(axes, f"{drawing.surface}, {drawing.robot}\n{drawing.covered:.1%} wiped")
    scale = axes.inset_axes((1.03, 0.0, 0.04, 1.0))
    axes.figure.colorbar(shades, cax=scale, label="contact time of each 5 mm cell, s")


def _draw_speed(axes: Axes, drawing: WipingDrawing) -> None:
    """Draw the speed of the tool along the lanes, and that of the commanded path without its overlay."""
    tool = "tool with overlay" if drawing.overlaid else "tool"
    axes.plot(drawing.time, drawing.tool_speed, color=TOOL, linewidth=0.7, label=tool)
    axes.plot(drawing.time, drawing.lane_speed, color=LANES, linewidth=1.2, label="lanes")
    axes.axhline(drawing.dwell_speed, color=TARGET, linewidth=1.0, linestyle=":", label="dwell below")
    _mark_pauses(axes, drawing)
    axes.set(xlabel="time from the first lane, s", ylabel="speed, mm/s")
    _set_title(axes, "Speed along lanes")


def _draw_force(axes: Axes, drawing: WipingDrawing) -> None:
    """Draw the normal force, from shortly before contact."""
    contacts = drawing.contact_time[drawing.force > 0]
    first = float(contacts[0] if contacts.size else drawing.contact_time[0]) - BEFORE_CONTACT_S
    axes.axvspan(drawing.time[0], drawing.time[-1], color=WIPING, linewidth=0, label="wiping")
    _mark_pauses(axes, drawing)
    axes.plot(drawing.contact_time, drawing.force, color=TOOL, linewidth=0.6, label="measured")
    axes.axhline(drawing.force_n, color=TARGET, linewidth=1.2, linestyle=":", label=f"commanded, {drawing.force_n:g} N")
    axes.set(xlabel="time from the first lane, s", ylabel="normal force, N", xlim=(first, drawing.time[-1]))
    axes.set_ylim(bottom=0)
    _set_title(axes, "Force on the surface")


def _mark_pauses(axes: Axes, drawing: WipingDrawing) -> None:
    for number, (start, end) in enumerate(drawing.pauses):
        label = "_paused" if number else "paused"
        axes.axvspan(start, end, facecolor="none", edgecolor=PAUSED, hatch="////", linewidth=0.5, label=label)


def _set_title(axes: Axes, title: str) -> None:
    """Place the title and the legend above the axes."""
    axes.set_title(title, loc="left")
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, frameon=False, borderaxespad=0.2, **COMPACT)
