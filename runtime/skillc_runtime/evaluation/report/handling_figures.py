"""The figures of a hand: its path with the things that it moved, and how its fingers gripped in each pick."""

from __future__ import annotations

from math import ceil
from typing import TYPE_CHECKING, Any

import numpy as np

from skillc_runtime.evaluation.report.handling_drawing import (
    DrawnBody,
    HandlingDrawing,
    Pick,
    Role,
    choose_axes,
    find_extent,
)
from skillc_runtime.evaluation.report.plotting import (
    DIM,
    GRID,
    INK,
    PAPER,
    SHADE,
    TRUTH,
    WIDTH_IN,
    add_legend,
    draw_band,
    draw_outline,
    plot_curve,
    start_figure,
    thin_rows,
    write_text,
)
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.shape.outlines import convex_hull

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

EMPTY, LOADED = DIM, TRUTH
"""Colours of the path of an empty hand and of one with a thing."""

LEAST_IN, MOST_IN, VIEWS_FRAME_IN = 1.6, 6.0, 1.7
"""Least and greatest height of a view, height of titles, axes and legend."""

MOST_NUMBERS = 20
"""With more picks, the places of grasps and releases have no numbers."""

MOST_COLUMNS, MOST_PICKS = 3, 12
"""At most so many picks are drawn, the first ones; the numbers of all are in the result."""

PICK_IN, PICKS_FRAME_IN = 3.2, 0.7
"""Heights of what is drawn of a row of picks, and of the legend."""

SHARE_ABOVE = 1.15
"""The scales end above the greatest value by this factor."""

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
    figure = start_figure(sum(heights) + VIEWS_FRAME_IN)
    above, beside = figure.subplots(2, 1, height_ratios=heights)
    _draw_view(above, drawing, (across, up), shown)
    _draw_view(beside, drawing, (across, 2), shown)
    if across == 1:
        above.invert_xaxis()
        beside.invert_xaxis()
    above.set_title("From above")
    beside.set_title("From the side")
    _name_styles(above, drawing)
    add_legend(figure)
    return figure


def draw_grips(drawing: HandlingDrawing) -> Figure:
    """Return the figure of the picks of one hand; all panels of a quantity have the same scale."""
    picks = drawing.picks[:MOST_PICKS]
    opening = max(1e3 * float(np.nanmax(pick.samples.opening, initial=0.0)) for pick in picks)
    force = max(float(np.nanmax(pick.samples.finger_force, initial=0.0)) for pick in picks)
    columns, panels = min(MOST_COLUMNS, len(picks)), 2 if force > 0.0 else 1
    rows = ceil(len(picks) / columns)
    figure = start_figure(PICK_IN * rows * (panels + 0.4) / 2.4 + PICKS_FRAME_IN)
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
    draw_outline(axes, hull, **STYLES[outline.role], **own)
    if order[1] == 2 or outline.role not in ("place", "start"):
        return
    low, high = hull.min(axis=0), hull.max(axis=0)
    at = ((low[0] + high[0]) / 2, high[1])
    write_text(axes, outline.name, at, (0, 3), ha="center", va="bottom", zorder=6, clip_on=True)


def _mark(axes: Axes, times: Array, places: Array, time: float, marker: str, number: str) -> None:
    """Mark where the hand was at a time in s, with the number of the pick."""
    at = places[min(int(np.searchsorted(times, time)), len(times) - 1)]
    axes.plot(*at, marker, color=LOADED, markeredgecolor=PAPER, markersize=11 if number else 5, zorder=5)
    axes.annotate(number, at, ha="center", va="center", color=PAPER, fontsize=7, fontweight="bold", zorder=6)


def _name_styles(axes: Axes, drawing: HandlingDrawing) -> None:
    """Name in the legend what each line and outline stands for."""
    roles = {"believed start" if each.role == "believed end" else each.role for each in drawing.outlines}
    axes.plot([], [], color=EMPTY, linewidth=0.9, label="hand, empty: simulator truth")
    axes.plot([], [], color=LOADED, linewidth=1.5, label="hand, with a part: simulator truth")
    axes.plot([], [], "o", color=LOADED, markersize=8, label="grasped")
    axes.plot([], [], "s", color=LOADED, markersize=8, label="released")
    for role, label in LEGEND:
        if role in roles:
            filled: dict[str, Any] = {"facecolor": EMPTY} if role in COLOURED else {}
            draw_outline(axes, np.full((1, 2), np.nan), label, **STYLES[role], **filled)


def _draw_opening(axes: Axes, pick: Pick, greatest_mm: float) -> None:
    time = _mark_held(axes, pick)
    plot_curve(axes, time, 1e3 * pick.samples.opening, "truth", "opening")
    plot_curve(axes, time, 1e3 * pick.samples.measured_opening, "sensor", "opening, as last read")
    axes.set(ylabel="opening, mm", ylim=(0.0, greatest_mm))


def _draw_force(axes: Axes, pick: Pick, greatest_n: float) -> None:
    """Draw the force; while a thing is held, it is that of the grasp."""
    plot_curve(axes, _mark_held(axes, pick), pick.samples.finger_force, "truth", "force of each finger")
    axes.set(ylabel="force, N", ylim=(0.0, greatest_n))


def _mark_held(axes: Axes, pick: Pick) -> Array:
    """Shade the time from the grasp to the release; return the time (n,) in s of the samples from the grasp."""
    time = pick.samples.time - pick.grasped_s
    released = time[-1] if pick.released_s is None else pick.released_s - pick.grasped_s
    draw_band(axes, 0.0, released, "from grasp to release")
    axes.set_xlim(time[0], time[-1])
    return time
