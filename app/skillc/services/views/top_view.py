"""Draws a scene from above as SVG: outlines of things, a grid in m, names. It needs no graphics library."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil, floor
from xml.sax.saxutils import escape

import numpy as np

from skillc_runtime.motion.pose import Array

PIXELS = 800
"""The longer side of the drawing, without its rim."""

RIM, LABEL = 46, 12
STEPS_M = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)
MOST_LINES = 16
"""The grid has the finest of STEPS_M with at most this many lines along the longer side."""

STYLE = (
    "text { font: 12px sans-serif; fill: #1c2128; } .grid { stroke: #d8dde3; } .axis { stroke: #8b949e; } "
    ".thing { stroke: #3b434b; stroke-width: 1.2; fill-opacity: 0.75; } .point { stroke: #0550ae; stroke-width: 1.5; } "
    ".number { fill: #57606a; font-size: 10px; }"
)


@dataclass(frozen=True, slots=True)
class Outline:
    """A thing seen from above: its name, a convex polygon (n, 2) in m of the world, its colour, the height of its top.

    The polygon of a thing without a size is one point. The height is in m.
    """

    name: str
    polygon: Array
    colour: str
    top_m: float


def draw_top_view(outlines: Sequence[Outline], title: str) -> str:
    """Return the drawing as an SVG document; the same outlines give the same bytes."""
    every = np.vstack([each.polygon for each in outlines]) if outlines else np.zeros((1, 2))
    span = float(max(np.ptp(every, axis=0).max(), 0.5))
    step = next((each for each in STEPS_M if span / each <= MOST_LINES), STEPS_M[-1])
    low = [floor(value / step - 0.25) * step for value in every.min(axis=0).tolist()]
    high = [ceil(value / step + 0.25) * step for value in every.max(axis=0).tolist()]
    view = _View(low[0], high[1], PIXELS / max(high[0] - low[0], high[1] - low[1]))
    width, height = view.at(high[0], low[1])
    size = f'width="{width + RIM:.0f}" height="{height + RIM:.0f}"'
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} viewBox="0 0 {width + RIM:.0f} {height + RIM:.0f}">',
        f"<title>{escape(title)}</title>",
        f"<style>{STYLE}</style>",
        '<rect width="100%" height="100%" fill="#ffffff"/>',
        *_grid(view, low, high, step),
    ]
    parts += [_shape(view, each) for each in sorted(outlines, key=lambda one: (one.top_m, one.name))]
    parts += [_label(view, each) for each in sorted(outlines, key=lambda one: one.name)]
    parts.append(f'<text x="{RIM}" y="16">{escape(title)}: from above, x to the right and y up, in m</text>')
    return "\n".join(('<?xml version="1.0" encoding="UTF-8"?>', *parts, "</svg>", ""))


@dataclass(frozen=True, slots=True)
class _View:
    left_m: float
    top_m: float
    scale: float

    def at(self, x: float, y: float) -> tuple[float, float]:
        """Return the pixel of a point in m of the world."""
        return RIM + (x - self.left_m) * self.scale, RIM / 2 + (self.top_m - y) * self.scale


def _grid(view: _View, low: Sequence[float], high: Sequence[float], step: float) -> Iterator[str]:
    (left, bottom), (right, top) = view.at(low[0], low[1]), view.at(high[0], high[1])
    for number in range(round((high[0] - low[0]) / step) + 1):
        x, _ = view.at(low[0] + number * step, 0.0)
        yield _line(low[0] + number * step, x, bottom, x, top)
        yield f'<text class="number" x="{x - 8:.1f}" y="{bottom + 14:.1f}">{low[0] + number * step:.4g}</text>'
    for number in range(round((high[1] - low[1]) / step) + 1):
        _, y = view.at(0.0, low[1] + number * step)
        yield _line(low[1] + number * step, left, y, right, y)
        yield f'<text class="number" x="8" y="{y + 4:.1f}">{low[1] + number * step:.4g}</text>'


def _line(metres: float, x1: float, y1: float, x2: float, y2: float) -> str:
    kind = "axis" if abs(metres) < 1e-9 else "grid"
    return f'<line class="{kind}" x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}"/>'


def _shape(view: _View, each: Outline) -> str:
    corners = [view.at(x, y) for x, y in each.polygon.tolist()]
    if len(corners) < 3:
        x, y = corners[0]
        return f'<path class="point" d="M{x - 5:.1f} {y:.1f}h10M{x:.1f} {y - 5:.1f}v10"/>'
    points = " ".join(f"{x:.1f},{y:.1f}" for x, y in corners)
    return f'<polygon class="thing" fill="{each.colour}" points="{points}"><title>{escape(each.name)}</title></polygon>'


def _label(view: _View, each: Outline) -> str:
    x, y = view.at(*each.polygon.max(axis=0).tolist())
    return f'<text x="{x + 3:.1f}" y="{y + LABEL:.1f}">{escape(each.name.rpartition(":")[2])}</text>'
