"""The figure of the fingers: how far they are open and how hard they press, a column of two panels for each pick."""

from __future__ import annotations

from math import ceil

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from skillc_runtime.evaluation.report.figure_style import SHADE, WIDTH_IN, add_legend, plot_curve
from skillc_runtime.evaluation.report.handling_drawing import HandlingDrawing, Pick

MOST_COLUMNS, MOST_PICKS = 3, 12
"""At most so many picks are drawn, the first ones; the numbers of all are in the result."""

ROW_IN, FRAME_IN = 3.2, 0.7
"""Heights of what is drawn of a row of picks, and of the legend."""

SHARE_ABOVE = 1.15
"""The scales end above the greatest value by this factor."""


def draw_grips(drawing: HandlingDrawing) -> Figure:
    """Return the figure of the picks of one hand; all panels of a quantity have the same scale."""
    picks = drawing.picks[:MOST_PICKS]
    opening = max(1e3 * float(np.nanmax(pick.samples.opening, initial=0.0)) for pick in picks)
    force = max(float(np.nanmax(pick.samples.finger_force, initial=0.0)) for pick in picks)
    columns, panels = min(MOST_COLUMNS, len(picks)), 2 if force > 0.0 else 1
    rows = ceil(len(picks) / columns)
    figure = Figure(figsize=(WIDTH_IN, ROW_IN * rows * (panels + 0.4) / 2.4 + FRAME_IN), layout="constrained")
    grid = figure.subplots(panels * rows, columns, squeeze=False)
    for number, pick in enumerate(picks):
        row, column = divmod(number, columns)
        opened = grid[panels * row, column]
        _draw_opening(opened, pick, SHARE_ABOVE * opening)
        opened.set_title(f"{number + 1}  {pick.name}")
        if panels == 2:
            _draw_force(grid[2 * row + 1, column], pick, SHARE_ABOVE * force)
        grid[panels * (row + 1) - 1, column].set_xlabel("time from the grasp, s")
    for unused in (axes for axes in grid.ravel() if not axes.lines):
        unused.set_visible(False)
    if len(drawing.picks) > len(picks):
        figure.suptitle(f"The first {len(picks)} of {len(drawing.picks)} picks", x=0.01, ha="left", fontsize=9.5)
    add_legend(figure)
    return figure


def _draw_opening(axes: Axes, pick: Pick, greatest_mm: float) -> None:
    time = _mark_held(axes, pick)
    plot_curve(axes, time, 1e3 * pick.samples.opening, "truth", "opening")
    plot_curve(axes, time, 1e3 * pick.samples.measured_opening, "sensor", "opening, as last read")
    axes.set(ylabel="opening, mm", ylim=(0.0, greatest_mm))


def _draw_force(axes: Axes, pick: Pick, greatest_n: float) -> None:
    """Draw the force; while a thing is held, it is that of the grasp."""
    plot_curve(axes, _mark_held(axes, pick), pick.samples.finger_force, "truth", "force of each finger")
    axes.set(ylabel="force, N", ylim=(0.0, greatest_n))


def _mark_held(axes: Axes, pick: Pick) -> np.ndarray:
    """Shade the time from the grasp to the release; return the time (n,) in s of the samples from the grasp."""
    time = pick.samples.time - pick.grasped_s
    released = time[-1] if pick.released_s is None else pick.released_s - pick.grasped_s
    axes.axvspan(0.0, released, color=SHADE, linewidth=0, zorder=0, label="from grasp to release")
    axes.set_xlim(time[0], time[-1])
    return time
