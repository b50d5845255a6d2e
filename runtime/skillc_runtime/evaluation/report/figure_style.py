"""How figures of reports look: colours, fonts and the line style of each source of a curve."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, Literal, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from skillc_runtime.motion.pose import Array

INK, DIM, PAPER, GRID, SHADE = "#1c2128", "#5d6873", "#ffffff", "#dfe3e8", "#eceff2"
"""Colours of text and axes, of secondary lines, of the background, of grid lines, and of intervals that are marked."""

TRUTH, SENSOR, ESTIMATE = "#c84e00", "#0069a6", "#a03a8a"
"""Colours that people with colour blindness can distinguish; curves also differ in their line style."""

DOSE = LinearSegmentedColormap.from_list("dose", ["#dcebf6", "#a9cde6", "#6ba6d0", "#3b7fb3"])
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


def plot_curve(axes: Axes, x: Array, y: Array, source: Source, what: str, **style: Any) -> None:
    """Draw a curve with the line style of its source; `what` it is, with the source, is its entry in the legend."""
    words, line = CURVES[source]
    axes.plot(*thin_curve(x, y), **{**line, "label": f"{what}: {words}", **style})


def plot_path(axes: Axes, points: Array, source: Source, what: str, **style: Any) -> None:
    """Draw a path through points (n, 2) with the line style of its source."""
    x, y = thin_rows(points).T
    words, line = CURVES[source]
    axes.plot(x, y, **{**line, "label": f"{what}: {words}", **style})


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


def find_force_range(force_n: Array, commanded_n: float | None) -> tuple[float, float]:
    """Return the limits in N of an axis on which the band of interest fills most of the height.

    They enclose all but the outermost percent of the forces (n,), and the commanded force with a tenth of it around.
    """
    known = force_n[np.isfinite(force_n)]
    low, high = np.percentile(known, (0.5, 99.5)) if known.size else (0.0, 1.0)
    if commanded_n is not None:
        low, high = min(low, 0.9 * commanded_n), max(high, 1.1 * commanded_n)
    room = 0.15 * max(high - low, 0.1)
    return float(low - room), float(high + room)


def mark_outliers(axes: Axes, x: Array, y: Array) -> None:
    """Say at the border how far a curve (n,), (n,) goes beyond the axes, so that no peak is hidden by their limits."""
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    shown = (x >= left) & (x <= right) & np.isfinite(y)
    if not shown.any():
        return
    places, values = x[shown], y[shown]
    for at, border, sign, offset in ((values.argmax(), high, "▲ up to", -11), (values.argmin(), low, "▼ down to", 4)):
        if not low <= values[at] <= high:
            near_end = places[at] > (left + right) / 2
            axes.annotate(
                f"{sign} {values[at]:.1f}", (places[at], border), (-4 if near_end else 4, offset),
                textcoords="offset points", ha="right" if near_end else "left", fontsize=8, color=INK, zorder=7,
                path_effects=[withStroke(linewidth=2.5, foreground=PAPER)],
            )  # fmt: skip


def average_over(values: Array, width: float) -> Array:
    """Return the moving mean of values (n,) over `width` samples; NaN where a value of it is none."""
    count = max(1, min(round(width), len(values)))
    weights = np.ones(count) / count
    inside = np.convolve(np.ones(len(values)), weights, mode="same")
    return np.asarray(np.convolve(values, weights, mode="same") / inside)


def fit_limits(axes: Axes, points: Array, margin: float, ratio: float) -> None:
    """Show points (n, 2) to scale, with a margin, in a part of the plane that is `ratio` times as wide as high."""
    low, high = points.min(axis=0) - margin, points.max(axis=0) + margin
    middle, (width, height) = (low + high) / 2, high - low
    half = np.array([max(width, ratio * height), max(height, width / ratio)]) / 2
    (left, bottom), (right, top) = middle - half, middle + half
    axes.set(xlim=(left, right), ylim=(bottom, top), aspect="equal", adjustable="box")
