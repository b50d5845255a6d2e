"""A plot of dots as it is drawn in a page: each is a trial, a candidate or another thing that was measured."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

MARGIN = 8
"""The distance in px of the outermost dots from the border."""


class Scale(msgspec.Struct, frozen=True):
    """A scale of values from `low` to `high`, which are drawn at `first` and `last`, in px."""

    low: float
    high: float
    first: float
    last: float

    def place(self, value: float) -> float:
        """Return where a value is drawn, in px."""
        share = (value - self.low) / (self.high - self.low)
        return round(self.first + (self.last - self.first) * share, 1)


class Dot(msgspec.Struct, frozen=True):
    """A dot at (x, y) in px; its `kind` is a class of the style sheet, `title` is what a pointer on it shows."""

    x: float
    y: float
    kind: str = ""
    title: str = ""
    radius: float = 3.0


class DotPlot(msgspec.Struct, frozen=True):
    """Dots over a scale of x, in a space of width and height in px; `name` is what is drawn.

    `lines` are upright ones, the class of the style sheet and x in px of each; `path` is a line through points (x, y).
    `across` and `up` are what stands below and above the dots, "" for nothing.
    """

    name: str
    width: int
    height: int
    x: Scale
    dots: tuple[Dot, ...]
    lines: tuple[tuple[str, float], ...] = ()
    path: tuple[tuple[float, float], ...] = ()
    across: str = ""
    up: str = ""


def fit_scale(values: Sequence[float], length: float, is_upwards: bool = False) -> Scale:
    """Return the scale on which values take `length` px, but for a margin at both ends; of equal ones the middle.

    Px count downwards: `is_upwards` puts greater values at smaller ones.
    """
    low, high = min(values, default=0.0), max(values, default=1.0)
    if high - low < 1e-9:
        low, high = low - 0.5, high + 0.5
    first, last = float(MARGIN), length - MARGIN
    return Scale(low, high, last, first) if is_upwards else Scale(low, high, first, last)
