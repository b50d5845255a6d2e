"""The figure of a push: force over time, and over the travel of the tool."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from skillc_runtime.evaluation.report.figure_style import DIM, SHADE, WIDTH_IN, add_legend, plot_curve
from skillc_runtime.evaluation.report.push_drawing import PushDrawing
from skillc_runtime.motion.pose import Array

HEIGHT_IN = 3.9
BEFORE_S = 0.5
"""How much of the approach is shown."""

ROOM = 1.08
"""The force axis ends above the greatest force by this factor."""


def draw_push(drawing: PushDrawing) -> Figure:
    """Return the figure of a push."""
    figure = Figure(figsize=(WIDTH_IN, HEIGHT_IN), layout="constrained")
    by_time, by_travel = figure.subplots(1, 2, sharey=True)
    push, time, travel = drawing.push, drawing.push.samples.time, drawing.push.travel_mm
    draw_force(by_time, drawing)
    by_time.set_title("Force over time")
    moved = time >= (push.start_s if push.contact_s is None else push.contact_s)
    if drawing.push.truth is not None:
        at = np.interp(drawing.push.truth[:, 0], time, travel)
        plot_curve(by_travel, at, drawing.push.truth[:, 1], "truth", "force")
    plot_curve(by_travel, travel[moved], push.force[moved], drawing.source, "force")
    plot_curve(by_travel, _ends(travel[moved]), np.full(2, push.force_n), "commanded", "force")
    by_travel.set(xlabel=f"travel of the tool after {'contact' if push.contact_s else 'its start'}, mm: estimate")
    by_travel.set_title("Force over travel")
    by_travel.tick_params(labelleft=True)
    add_legend(figure)
    return figure


def draw_force(axes: Axes, drawing: PushDrawing) -> None:
    """Draw the force of a push over time, all that is known of it."""
    push, time = drawing.push, drawing.push.samples.time - drawing.push.start_s
    if push.contact_s is not None:
        axes.axvspan(push.contact_s - push.start_s, time[-1], color=SHADE, linewidth=0, zorder=0, label="in contact")
    if drawing.push.truth is not None:
        plot_curve(axes, drawing.push.truth[:, 0] - push.start_s, drawing.push.truth[:, 1], "truth", "force")
    plot_curve(axes, time, push.force, drawing.source, "force")
    plot_curve(axes, _ends(time), np.full(2, push.force_n), "commanded", "force")
    if drawing.switched_s is not None:
        when = drawing.switched_s - push.start_s
        axes.axvline(when, color=DIM, linewidth=1.0, linestyle=(0, (6, 3)), label="switched: simulator truth")
    every = [push.force] if drawing.push.truth is None else [push.force, drawing.push.truth[:, 1]]
    least, greatest = (float(find([find(each) for each in every])) for find in (min, max))
    first = time[0] if push.contact_s is None else max(time[0], push.contact_s - push.start_s - BEFORE_S)
    axes.set(xlabel="time from the start of the push, s", ylabel="force, N", xlim=(first, time[-1]))
    axes.set_ylim(min(least, 0.0) - 0.05 * push.force_n, ROOM * max(greatest, push.force_n))


def _ends(values: Array) -> Array:
    return np.array([values.min(initial=0.0), values.max(initial=0.0)])
