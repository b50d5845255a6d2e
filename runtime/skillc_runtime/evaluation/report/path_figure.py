"""The figure of the path of a hand: from above and from the side, with the things that it moved, to scale."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from matplotlib.patheffects import withStroke

from skillc_runtime.evaluation.report.figure_style import DIM, GRID, INK, PAPER, SHADE, TRUTH, WIDTH_IN, thin_rows
from skillc_runtime.evaluation.report.handling_drawing import DrawnBody, HandlingDrawing, Role, choose_axes, find_extent
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.shape.outlines import convex_hull

EMPTY, LOADED = DIM, TRUTH
"""Colours of the path of an empty hand and of one with a thing."""

LEAST_IN, MOST_IN, FRAME_IN = 1.6, 6.0, 1.7
"""Least and greatest height of a view, height of titles, axes and legend."""

MOST_NUMBERS = 20
"""With more picks, the places of grasps and releases have no numbers."""

DASHED: dict[str, Any] = {"fill": False, "edgecolor": INK, "linewidth": 1.1, "linestyle": (0, (3, 2)), "zorder": 3}
STYLES: dict[Role, dict[str, Any]] = {
    "scenery": {"facecolor": SHADE, "edgecolor": GRID, "linewidth": 0.8, "zorder": 0},
    "place": {"edgecolor": DIM, "linewidth": 1.2, "alpha": 0.75, "zorder": 1},
    "start": {"edgecolor": INK, "linewidth": 0.8, "alpha": 0.35, "zorder": 2},
    "end": {"edgecolor": INK, "linewidth": 1.1, "zorder": 2.5},
    "believed start": DASHED,
    "believed end": DASHED,
}
COLOURED: tuple[Role, ...] = ("place", "start", "end")
"""The roles whose outlines are filled with the colour of the thing."""

LEGEND: tuple[tuple[Role, str], ...] = (
    ("start", "at the start"),
    ("end", "at the end"),
    ("believed start", "believed"),
)


def draw_path(drawing: HandlingDrawing, across: int | None = None) -> Figure:
    """Return the figure of one hand; `across` is the axis of the world that lies across in both views."""
    across = choose_axes([drawing]) if across is None else across
    shown, up = find_extent(drawing), 1 - across
    heights = [_find_height(shown, axis, across) for axis in (up, 2)]
    figure = Figure(figsize=(WIDTH_IN, sum(heights) + FRAME_IN), layout="constrained")
    above, beside = figure.subplots(2, 1, height_ratios=heights)
    _draw_view(above, drawing, (across, up), shown)
    _draw_view(beside, drawing, (across, 2), shown)
    if across == 1:
        above.invert_xaxis()
        beside.invert_xaxis()
    above.set_title("From above")
    beside.set_title("From the side")
    _add_legend(figure, above, drawing)
    return figure


def _find_height(shown: Array, axis: int, across: int) -> float:
    """Return the height of a view in inches, to scale if that is neither too low nor too high."""
    scaled = 0.85 * WIDTH_IN * float(np.ptp(shown[:, axis])) / float(np.ptp(shown[:, across]))
    return min(max(LEAST_IN, scaled), MOST_IN)


def _draw_view(axes: Axes, drawing: HandlingDrawing, order: tuple[int, int], shown: Array) -> None:
    """Draw outlines and path onto two axes of the world, which are numbered from 0."""
    for each in sorted(drawing.outlines, key=lambda one: float(one.points[:, 2].max())):
        _draw_outline(axes, each, order)
    rows = thin_rows(drawing.path.rows)
    time, places = rows[:, 0], 1e3 * rows[:, 1:4][:, list(order)]
    loaded = np.zeros(len(time), dtype=bool)
    for pick in drawing.picks:
        loaded |= (time >= pick.grasped_s) & (time <= (time[-1] if pick.released_s is None else pick.released_s))
    for colour, drawn, width in ((EMPTY, ~loaded, 0.9), (LOADED, loaded, 1.5)):
        axes.plot(*np.where(drawn[:, None], places, np.nan).T, color=colour, linewidth=width, zorder=4)
    numbered = len(drawing.picks) <= MOST_NUMBERS
    for number, pick in enumerate(drawing.picks, 1):
        _mark(axes, time, places, pick.grasped_s, "o", str(number) if numbered else "")
        if pick.released_s is not None:
            _mark(axes, time, places, pick.released_s, "s", str(number) if numbered else "")
    axes.set(xlim=shown[:, order[0]], ylim=shown[:, order[1]], aspect="equal")
    axes.set(xlabel=f"{'xyz'[order[0]]} in the world, mm", ylabel=f"{'xyz'[order[1]]} in the world, mm")


def _draw_outline(axes: Axes, outline: DrawnBody, order: tuple[int, int]) -> None:
    hull = 1e3 * convex_hull(outline.points[:, list(order)])
    own: dict[str, Any] = {"facecolor": outline.colour} if outline.role in COLOURED else {}
    axes.add_patch(Polygon(hull, closed=True, **STYLES[outline.role], **own))
    if order[1] == 2 or outline.role not in ("place", "start"):
        return
    low, high = hull.min(axis=0), hull.max(axis=0)
    axes.annotate(
        outline.name, ((low[0] + high[0]) / 2, high[1]), (0, 3), textcoords="offset points",
        ha="center", va="bottom", color=INK, fontsize=8, zorder=6, clip_on=True,
        path_effects=[withStroke(linewidth=2.5, foreground=PAPER)],
    )  # fmt: skip


def _mark(axes: Axes, times: Array, places: Array, time: float, marker: str, number: str) -> None:
    """Mark where the hand was at a time in s, with the number of the pick."""
    at = places[min(int(np.searchsorted(times, time)), len(times) - 1)]
    axes.plot(*at, marker, color=LOADED, markeredgecolor=PAPER, markersize=11 if number else 5, zorder=5)
    axes.annotate(number, at, ha="center", va="center", color=PAPER, fontsize=7, fontweight="bold", zorder=6)


def _add_legend(figure: Figure, axes: Axes, drawing: HandlingDrawing) -> None:
    roles = {"believed start" if each.role == "believed end" else each.role for each in drawing.outlines}
    handles: list[Any] = [
        *axes.plot([], [], color=EMPTY, linewidth=0.9, label="hand, empty: simulator truth"),
        *axes.plot([], [], color=LOADED, linewidth=1.5, label="hand, with a part: simulator truth"),
        *axes.plot([], [], "o", color=LOADED, markersize=8, label="grasped"),
        *axes.plot([], [], "s", color=LOADED, markersize=8, label="released"),
    ]
    for role, label in LEGEND:
        if role in roles:
            filled: dict[str, Any] = {"facecolor": EMPTY} if role in COLOURED else {}
            handles.append(Polygon([(0.0, 0.0)], label=label, **STYLES[role], **filled))
    figure.legend(handles=handles, loc="outside lower left", ncols=4)
