"""The figures of an arm that was guided by hand, and of a mobile base that drove: their paths, to scale."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from skillc_runtime.evaluation.report.guidances import FreePeriod
from skillc_runtime.evaluation.report.plotting import (
    DIM,
    INK,
    SHADE,
    add_legend,
    draw_outline,
    fit_limits,
    mark_place,
    plot_curve,
    plot_path,
    start_figure,
    thin_rows,
)
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.bodies import read_bodies
from skillc_runtime.world.space.shape.outlines import convex_hull, outline_points
from skillc_runtime.world.state.labels.labelled import display_name
from skillc_runtime.world.state.world_state import WorldState

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

GUIDANCE_IN, DRIVE_IN = 5.6, 5.0
"""The heights of the figures."""

MARGIN_MM, GUIDANCE_RATIO = 15.0, 1.9
"""How much is shown around the path of a tool, and how many times as wide as high its views are."""

NEAR_M, MARGIN_M, DRIVE_RATIO = 1.5, 0.3, 2.2
"""What is nearer to the path of a base is shown whole; how much is shown around that, as above."""

MOST_NAMES = 60
"""With more bodies around the path of a base, they have no names."""


def draw_guidance(period: FreePeriod) -> Figure:
    """Return the figure of a time in which an arm yielded in all directions."""
    figure = start_figure(GUIDANCE_IN)
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
    shown: dict[str, Any] = {"xlim": (0.0, time[-1] - start), "ylim": (0.0, None)}
    force.set(ylabel="force, N", **shown)
    force.set_title("Force of the person" if period.guidance is not None else "Nobody guided the tool")
    plot_curve(speed, time - start, period.speed_mm_s, "estimate", "speed of the tool", linestyle="-")
    speed.set(xlabel="time since the arm yields, s", ylabel="speed, mm/s", **shown)
    speed.set_title("Speed of the tool")
    add_legend(figure)
    return figure


def draw_drive(path: Array, outlines: tuple[tuple[str, Array], ...]) -> Figure:
    """Return the figure of a base: its `path` (n, 4), s and m in the world, and what stands around it.

    `outlines` are those of fixed bodies, from above: the name and the outline (m, 2) in m of each.
    """
    figure = start_figure(DRIVE_IN)
    axes = figure.subplots()
    places = thin_rows(path[:, 1:3])
    near: list[Array] = []
    for name, hull in outlines:
        middle = hull.mean(axis=0)
        if float(np.linalg.norm(places[:, None] - middle, axis=2).min()) < NEAR_M:
            near.append(hull)
        draw_outline(axes, hull, facecolor=SHADE, edgecolor=DIM, linewidth=0.8, zorder=1)
        if len(outlines) <= MOST_NAMES:
            axes.annotate(name, middle, ha="center", va="center", fontsize=8, color=INK, zorder=2, clip_on=True)
    plot_path(axes, places, "sensor", "path of the base", linestyle="-", linewidth=1.6)
    _mark_ends(axes, places)
    fit_limits(axes, np.vstack([places, *near]), MARGIN_M, DRIVE_RATIO)
    axes.set(xlabel="x in the world, m", ylabel="y in the world, m")
    axes.set_title("Path of the base from above")
    add_legend(figure)
    return figure


def list_outlines(state: WorldState) -> tuple[tuple[str, Array], ...]:
    """Return the name and the outline (m, 2) from above, in m in the world, of each fixed body."""
    bodies = (each for each in read_bodies(state) if not each.movable)
    hulls = ((each, outline_points(state, each.individual, each.pose)[:, :2]) for each in bodies)
    return tuple((display_name(each.individual), convex_hull(points)) for each, points in hulls)


def _draw_view(axes: Axes, period: FreePeriod, path: Array, order: tuple[int, int]) -> None:
    """Draw the path of a tool onto two axes of the world, to scale."""
    columns = list(order)
    shown = path[:, columns]
    plot_path(axes, shown, "estimate", "path of the tool", linestyle="-")
    _mark_ends(axes, shown)
    if period.guidance is not None:
        place = 1e3 * period.guidance.place[columns]
        mark_place(axes, place, "marked", "intended by the person")
        shown = np.vstack([shown, place])
    fit_limits(axes, shown, MARGIN_MM, GUIDANCE_RATIO)
    if order[0] == 1:  # x upwards and y to the left, as seen from above
        axes.invert_xaxis()
    axes.set(xlabel=f"{'xyz'[order[0]]} in the world, mm", ylabel=f"{'xyz'[order[1]]} in the world, mm")


def _mark_ends(axes: Axes, path: Array) -> None:
    mark_place(axes, path[0], "began", "began")
    mark_place(axes, path[-1], "ended", "ended")
