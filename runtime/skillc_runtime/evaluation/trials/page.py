"""A series of trials as one self-contained HTML page, with a drawing of how each metric spreads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from jinja2 import Environment, PackageLoader, StrictUndefined

from skillc_runtime.evaluation.trials.series import Series, Spread
from skillc_runtime.evaluation.trials.table import unverified_words

WIDTH, HEIGHT, MARGIN = 420, 34, 8
"""Of a drawing, px."""


@dataclass(frozen=True, slots=True)
class Strip:
    """A spread with its drawing: px of each trial, from left to right as the seeds are up and down, and of the target.

    The scale goes from `low` to `high` in the unit of the metric; some metrics have no target.
    """

    spread: Spread
    low: float
    high: float
    dots: tuple[tuple[float, float], ...]
    median: float
    target: float | None


def render(series: Series) -> str:
    """Return the page."""
    environment = Environment(
        loader=PackageLoader("skillc_runtime.evaluation.trials", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    strips = [strip(spread) for spread in series.spreads]
    return environment.get_template("page.html.j2").render(
        series=series, unverified=unverified_words(series), strips=strips, width=WIDTH, height=HEIGHT
    )


def strip(spread: Spread) -> Strip:
    """Return the drawing of one spread: every trial a dot, the target a line."""
    wanted = spread.bound
    low, high = _scale(spread.values if wanted is None else (*spread.values, wanted))

    def at(value: float) -> float:
        return round(MARGIN + (WIDTH - 2 * MARGIN) * (value - low) / (high - low), 1)

    lines = _lines(len(spread.values))
    dots = tuple((at(value), line) for value, line in zip(spread.values, lines, strict=True))
    return Strip(spread, low, high, dots, at(spread.median), None if wanted is None else at(wanted))


def _scale(values: Sequence[float]) -> tuple[float, float]:
    low, high = min(values), max(values)
    if high - low < 1e-9:
        return low - 0.5, high + 0.5
    return low, high


def _lines(count: int) -> list[float]:
    """Return heights that are spread over the drawing, so that equal values do not hide each other."""
    return [round(MARGIN + (HEIGHT - 2 * MARGIN) * (number * 0.618 % 1.0), 1) for number in range(count)]
