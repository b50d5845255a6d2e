"""The figure of a mobile base: its path on the floor, and what stands around it."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from skillc_runtime.evaluation.report.drive_drawing import DriveDrawing
from skillc_runtime.evaluation.report.figure_style import (
    DIM,
    INK,
    PAPER,
    SHADE,
    WIDTH_IN,
    add_legend,
    fit_limits,
    plot_path,
    thin_rows,
)
from skillc_runtime.motion.pose import Array

HEIGHT_IN, NEAR_M, AROUND_M, RATIO = 5.0, 1.5, 0.3, 2.2
"""Height of the figure; what is nearer to the path is shown whole; how much is shown around that, and how many times as
wide as high this is."""

MOST_BODIES = 60
"""With more bodies around, only their outlines are drawn, without names."""


def draw_drive(drawing: DriveDrawing) -> Figure:
    """Return the figure of a base."""
    figure = Figure(figsize=(WIDTH_IN, HEIGHT_IN), layout="constrained")
    axes = figure.subplots()
    places = thin_rows(drawing.path[:, 1:3])
    near: list[Array] = []
    for name, hull in drawing.outlines:
        if float(np.linalg.norm(places[:, None] - hull.mean(axis=0), axis=2).min()) < NEAR_M:
            near.append(hull)
        axes.add_patch(Polygon(hull, closed=True, facecolor=SHADE, edgecolor=DIM, linewidth=0.8, zorder=1))
        if len(drawing.outlines) <= MOST_BODIES:
            axes.annotate(
                name, hull.mean(axis=0), ha="center", va="center", fontsize=8, color=INK,
                zorder=2, clip_on=True,
            )  # fmt: skip
    plot_path(axes, places, "sensor", "path of the base", linestyle="-", linewidth=1.6)
    axes.plot(*places[0], "o", color=INK, markeredgecolor=PAPER, markersize=8, zorder=6, label="began")
    axes.plot(*places[-1], "s", color=INK, markeredgecolor=PAPER, markersize=8, zorder=6, label="ended")
    fit_limits(axes, np.vstack([places, *near]), AROUND_M, RATIO)
    axes.set(xlabel="x in the world, m", ylabel="y in the world, m")
    axes.set_title("Path of the base from above")
    add_legend(figure)
    return figure
