"""A series of trials as one self-contained HTML page, with a plot of the spread of each metric."""

from __future__ import annotations

from pathlib import Path

from skillc_runtime.evaluation.pages.dots import MARGIN, Dot, DotPlot, fit_scale
from skillc_runtime.evaluation.pages.page import make_page
from skillc_runtime.evaluation.trials.series import Series, Spread
from skillc_runtime.evaluation.trials.summary import format_false_successes, format_unverified

WIDTH, HEIGHT = 420, 34
"""The size of a plot in px."""


def render_page(series: Series) -> str:
    """Return the page."""
    return make_page(
        Path(__file__).parent / "page.html.j2",
        series=series,
        false_successes=format_false_successes(series),
        unverified=format_unverified(series),
        plots=[(each, plot_spread(each)) for each in series.spreads],
    )


def plot_spread(spread: Spread) -> DotPlot:
    """Return the plot of one spread, with a dot for each trial, and lines for the median and the target."""
    target = [] if spread.bound is None else [spread.bound]
    x = fit_scale((*spread.values, *target), WIDTH)
    dots = tuple(Dot(x.place(value), y) for value, y in zip(spread.values, _heights(len(spread.values)), strict=True))
    lines = (("median", x.place(spread.median)), *(("target", x.place(each)) for each in target))
    return DotPlot(f"{spread.metric}, spread", WIDTH, HEIGHT, x, dots, lines)


def _heights(count: int) -> list[float]:
    """Return vertical positions in px, distributed so that equal values do not cover each other."""
    return [round(MARGIN + (HEIGHT - 2 * MARGIN) * (number * 0.618 % 1.0), 1) for number in range(count)]
