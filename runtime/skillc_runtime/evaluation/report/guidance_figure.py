"""The figure of an arm that was guided by hand: its path, the force of the person, the speed of the tool."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from skillc_runtime.evaluation.report.figure_style import (
    INK,
    PAPER,
    WIDTH_IN,
    add_legend,
    fit_limits,
    plot_curve,
    plot_path,
    thin_rows,
)
from skillc_runtime.evaluation.report.guidances import FreePeriod
from skillc_runtime.motion.pose import Array

HEIGHT_IN = 5.6
MARGIN_MM, RATIO = 15.0, 1.9
"""How much is shown around a path, and how many times as wide as high its views are."""


def draw_guidance(period: FreePeriod) -> Figure:
    """Return the figure of a time in which an arm yielded in all directions."""
    figure = Figure(figsize=(WIDTH_IN, HEIGHT_IN), layout="constrained")
    (above, force), (beside, speed) = figure.subplots(2, 2)
    path = 1e3 * thin_rows(period.samples.position)
    across = 0 if np.ptp(path[:, 0]) >= np.ptp(path[:, 1]) else 1
    _draw_view(above, period, path, (across, 1 - across))
    above.set_title("Path of the tool from above")
    _draw_view(beside, period, path, (across, 2))
    beside.set_title("From the side")
    start, time = period.samples.time[0], period.samples.time
    if period.guidance is not None:
        plot_curve(force, period.guidance.times - start, period.guidance.forces, "truth", "force of the person")
    force.set(ylabel="force, N", xlim=(0.0, time[-1] - start), ylim=(0.0, None))
    force.set_title("Force of the person" if period.guidance is not None else "Nobody guided the tool")
    plot_curve(speed, time - start, period.speed_mm_s, "estimate", "speed of the tool", linestyle="-")
    speed.set(
        xlabel="time since the arm yields, s", ylabel="speed, mm/s", xlim=(0.0, time[-1] - start), ylim=(0.0, None)
    )
    speed.set_title("Speed of the tool")
    add_legend(figure)
    return figure


def _draw_view(axes: Axes, period: FreePeriod, path: Array, order: tuple[int, int]) -> None:
    """Draw the path onto two axes of the world, to scale."""
    columns = list(order)
    shown = path[:, columns]
    plot_path(axes, shown, "estimate", "path of the tool", linestyle="-")
    axes.plot(*shown[0], "o", color=INK, markeredgecolor=PAPER, markersize=7, zorder=6, label="began")
    axes.plot(*shown[-1], "s", color=INK, markeredgecolor=PAPER, markersize=7, zorder=6, label="ended")
    if period.guidance is not None:
        place = 1e3 * period.guidance.place[columns]
        axes.plot(*place, "x", color=INK, markersize=9, markeredgewidth=2, zorder=7, label="intended by the person")
        shown = np.vstack([shown, place])
    fit_limits(axes, shown, MARGIN_MM, RATIO)
    if order[0] == 1:  # x upwards and y to the left, as seen from above
        axes.invert_xaxis()
    axes.set(xlabel=f"{'xyz'[order[0]]} in the world, mm", ylabel=f"{'xyz'[order[1]]} in the world, mm")
