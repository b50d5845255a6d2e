"""A series of trials as one self-contained HTML page, with a drawing of the spread of each metric."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from jinja2 import Environment, PackageLoader, StrictUndefined

from skillc_runtime.evaluation.trials.series import Series, Spread
from skillc_runtime.evaluation.trials.summary import format_false_successes, format_unverified

WIDTH, HEIGHT, MARGIN = 420, 34, 8
"""The size of a drawing in px."""


@dataclass(frozen=True, slots=True)
class Strip:
    """A spread with its drawing: positions (x, y) of the trials, and x of the median and of the target, in px.

    The scale is from `low` to `high` in the unit of the metric; `target` is None if the metric has none.
    """

    spread: Spread
    low: float
    high: float
    dots: tuple[tuple[float, float], ...]
    median: float
    target: float | None


def render_page(series: Series) -> str:
    """Return the page."""
    environment = Environment(
        loader=PackageLoader("skillc_runtime.evaluation.trials", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    strips = [draw_strip(spread) for spread in series.spreads]
    return environment.get_template("page.html.j2").render(
        series=series,
        false_successes=format_false_successes(series),
        unverified=format_unverified(series),
        strips=strips,
        width=WIDTH,
        height=HEIGHT,
    )


def draw_strip(spread: Spread) -> Strip:
    """Return the drawing of one spread, with a dot for each trial and a line for the target."""
    target = spread.bound
    low, high = _scale(spread.values if target is None else (*spread.values, target))

    def x_of(value: float) -> float:
        return round(MARGIN + (WIDTH - 2 * MARGIN) * (value - low) / (high - low), 1)

    heights = _row_heights(len(spread.values))
    dots = tuple((x_of(value), height) for value, height in zip(spread.values, heights, strict=True))
    return Strip(spread, low, high, dots, x_of(spread.median), None if target is None else x_of(target))


def _scale(values: Sequence[float]) -> tuple[float, float]:
    low, high = min(values), max(values)
    if high - low < 1e-9:
        return low - 0.5, high + 0.5
    return low, high


def _row_heights(count: int) -> list[float]:
    """Return vertical positions in px, distributed so that equal values do not cover each other."""
    return [round(MARGIN + (HEIGHT - 2 * MARGIN) * (number * 0.618 % 1.0), 1) for number in range(count)]
