"""What figures of reports are drawn with: axes, curves, paths, bands, maps, outlines and marks, all in one style.

Only this module draws with matplotlib, which takes long to import and is imported with the first figure.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from skillc_runtime.motion.pose import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

INK, DIM, PAPER, GRID, SHADE = "#1c2128", "#5d6873", "#ffffff", "#dfe3e8", "#eceff2"
"""Colours of text and axes, of secondary lines, of the background, of grid lines, and of intervals that are marked."""

TRUTH, SENSOR, ESTIMATE = "#c84e00", "#0069a6", "#a03a8a"
"""Colours that people with colour blindness can distinguish; curves also differ in their line style."""

DOSE = ("#dcebf6", "#a9cde6", "#6ba6d0", "#3b7fb3")
"""From light to dark, so that more looks like more; no colour that looks like a warning."""

STYLE: Any = MappingProxyType(
    {
        "font.size": 9, "axes.titlesize": 9.5, "axes.titleweight": "bold", "axes.titlelocation": "left",
        "legend.fontsize": 8.5, "legend.frameon": False, "figure.facecolor": PAPER, "axes.facecolor": "none",
        "savefig.facecolor": PAPER, "text.color": INK, "axes.labelcolor": INK, "axes.titlecolor": INK,
        "axes.edgecolor": DIM, "xtick.color": DIM, "ytick.color": DIM, "xtick.labelcolor": INK,
        "ytick.labelcolor": INK, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
        "grid.color": GRID, "grid.linewidth": 0.6, "axes.axisbelow": True, "svg.fonttype": "none",
        "svg.hashsalt": "skillc",
        "figure.constrained_layout.h_pad": 0.08, "font.sans-serif": ["DejaVu Sans", "Verdana", "Arial", "sans-serif"],
    }
)  # fmt: skip
"""The settings of matplotlib; text in an SVG remains text."""

WIDTH_IN = 10.0
"""The width of all figures: the page shows them at their full width."""

Source: TypeAlias = Literal["truth", "sensor", "estimate", "commanded"]
"""Where a curve comes from: the simulator, a sensor of the robot, an estimate of the robot's, or a command."""

CURVES: Mapping[Source, tuple[str, Mapping[str, Any]]] = MappingProxyType(
    {
        "truth": ("simulator truth", {"color": TRUTH, "linewidth": 1.1, "linestyle": "-", "zorder": 3}),
        "sensor": ("sensor", {"color": SENSOR, "linewidth": 1.1, "linestyle": (0, (4, 1.5)), "zorder": 4}),
        "estimate": ("estimate", {"color": ESTIMATE, "linewidth": 1.1, "linestyle": (0, (4, 1, 1, 1)), "zorder": 4}),
        "commanded": ("commanded", {"color": INK, "linewidth": 1.2, "linestyle": (0, (1, 1)), "zorder": 5}),
    }
)
"""The words of the legend and the line style of each source."""

COLUMN_IN, LETTER_IN = 0.68, 0.076
"""Width of a column of a legend without its text, and of a letter."""

MOST_POINTS = 4000
"""Longer curves are drawn as the range of each stretch of them, so that no peak is lost."""


Mark: TypeAlias = Literal["began", "ended", "marked"]

MARKS: Mapping[Mark, Mapping[str, Any]] = MappingProxyType(
    {
        "began": {"marker": "o", "markeredgecolor": PAPER, "markersize": 7, "zorder": 6},
        "ended": {"marker": "s", "markeredgecolor": PAPER, "markersize": 7, "zorder": 6},
        "marked": {"marker": "x", "markeredgewidth": 2, "markersize": 9, "zorder": 7},
    }
)
"""How a place on a path is marked: where it began, where it ended, and what it was about."""

BROKEN: Mapping[str, Any] = MappingProxyType({"color": DIM, "linewidth": 1.0, "linestyle": (0, (6, 3))})
"""The line of a time or a level that is compared with a curve."""


def start_figure(height_in: float) -> Figure:
    """Return an empty figure of the width of the page, `height_in` inches high."""
    from matplotlib.figure import Figure

    return Figure(figsize=(WIDTH_IN, height_in), layout="constrained")


def plot_curve(axes: Axes, x: Array, y: Array, source: Source, what: str, **style: Any) -> None:
    """Draw a curve with the line style of its source; `what` it is, with the source, is its entry in the legend."""
    words, line = CURVES[source]
    axes.plot(*thin_curve(x, y), **{**line, "label": f"{what}: {words}", **style})


def plot_path(axes: Axes, points: Array, source: Source, what: str, **style: Any) -> None:
    """Draw a path through points (n, 2) with the line style of its source."""
    x, y = thin_rows(points).T
    words, line = CURVES[source]
    axes.plot(x, y, **{**line, "label": f"{what}: {words}", **style})


def mark_place(axes: Axes, place: Array, mark: Mark, what: str) -> None:
    """Mark a place (2,); `what` it is, is its entry in the legend."""
    axes.plot(*place, linestyle="none", color=INK, label=what, **MARKS[mark])


def draw_band(axes: Axes, start: float, end: float, what: str) -> None:
    """Shade an interval of x behind all curves."""
    axes.axvspan(start, end, color=SHADE, linewidth=0, zorder=0, label=what)


def draw_outline(axes: Axes, hull: Array, what: str = "", **style: Any) -> None:
    """Draw a closed outline (n, 2); `what` it is, is its entry in the legend, "" for none."""
    from matplotlib.patches import Polygon

    axes.add_patch(Polygon(hull, closed=True, **({"label": what} if what else {}), **style))


def draw_map(
    axes: Axes, values: Array, half: Array, colours: Sequence[str], greatest: float, zorder: float = 1.0
) -> Any:
    """Draw values (rows along y, columns along x) as cells of a rectangle of twice the size `half` (2,) around 0.

    Values of 0 are left out; `colours` go from 0 to the `greatest` value. Return what a colour bar is made from.
    """
    from matplotlib.colors import LinearSegmentedColormap, ListedColormap

    scale = LinearSegmentedColormap.from_list("map", colours) if len(colours) > 1 else ListedColormap(colours)
    x, y = half
    return axes.imshow(
        np.ma.masked_equal(values, 0), extent=(-x, x, -y, y), origin="lower", cmap=scale,
        vmin=0.0, vmax=greatest, interpolation="nearest", zorder=zorder,
    )  # fmt: skip


def write_text(axes: Axes, text: str, at: Any, offset: tuple[float, float], **style: Any) -> None:
    """Write text beside a place, `offset` (2,) in points from it, readable over curves."""
    from matplotlib.patheffects import withStroke

    halo = [withStroke(linewidth=2.5, foreground=PAPER)]
    axes.annotate(text, at, offset, textcoords="offset points", fontsize=8, color=INK, path_effects=halo, **style)


def thin_curve(x: Array, y: Array) -> tuple[Array, Array]:
    """Return a curve (n,), (n,) with at most about MOST_POINTS points: the least and greatest y of each stretch."""
    if len(x) <= MOST_POINTS:
        return x, y
    width = -(-len(x) * 2 // MOST_POINTS)
    missing = -len(y) % width
    stretches = np.append(y, np.full(missing, np.nan)).reshape(-1, width)
    unknown = np.isnan(stretches)
    least = np.where(unknown, np.inf, stretches).argmin(axis=1)
    greatest = np.where(unknown, -np.inf, stretches).argmax(axis=1)
    greatest[unknown.all(axis=1)] = width - 1
    starts = np.arange(0, len(y), width)
    kept = np.unique(np.minimum(np.concatenate((starts + least, starts + greatest)), len(y) - 1))
    return x[kept], y[kept]


def thin_rows(rows: Array) -> Array:
    """Return evenly spaced rows (m, k) of a path (n, k), at most MOST_POINTS, with its last one."""
    if len(rows) <= MOST_POINTS:
        return rows
    return np.asarray(rows[np.unique(np.linspace(0, len(rows) - 1, MOST_POINTS).astype(int))])


def add_legend(figure: Figure) -> None:
    """Add one legend below all axes of a figure, with each entry once, in as many columns as fit."""
    found: dict[str, Any] = {}
    for axes in figure.axes:
        handles, names = axes.get_legend_handles_labels()
        for name, handle in zip(names, handles, strict=True):
            found.setdefault(name, handle)
    if found:
        figure.legend(list(found.values()), list(found), loc="outside lower left", ncols=count_columns(list(found)))


def count_columns(names: Sequence[str]) -> int:
    """Return how many columns a legend with these names may have within the width of a figure."""
    for columns in range(len(names), 1, -1):
        parts = (names[int(part[0]) : int(part[-1]) + 1] for part in np.array_split(np.arange(len(names)), columns))
        if sum(COLUMN_IN + LETTER_IN * max(map(len, part)) for part in parts) <= WIDTH_IN:
            return columns
    return 1


def mark_outliers(axes: Axes, x: Array, y: Array) -> None:
    """Say at the border how far a curve (n,), (n,) goes beyond the axes, so that no peak is hidden by their limits."""
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    shown = (x >= left) & (x <= right) & np.isfinite(y)
    if not shown.any():
        return
    places, values = x[shown], y[shown]
    for at, border, sign, offset in ((values.argmax(), high, "▲ up to", -11), (values.argmin(), low, "▼ down to", 4)):
        if not low <= values[at] <= high:
            offset_x, side = (-4, "right") if places[at] > (left + right) / 2 else (4, "left")
            write_text(axes, f"{sign} {values[at]:.1f}", (places[at], border), (offset_x, offset), ha=side, zorder=7)


def fit_limits(axes: Axes, points: Array, margin: float, ratio: float) -> None:
    """Show points (n, 2) to scale, with a margin, in a part of the plane that is `ratio` times as wide as high."""
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    middle, (width, height) = (low + high) / 2, high - low
    half = np.array([max(width, ratio * height), max(height, width / ratio)]) / 2
    (left, bottom), (right, top) = middle - half, middle + half
    axes.set(xlim=(left, right), ylim=(bottom, top), aspect="equal", adjustable="box")
