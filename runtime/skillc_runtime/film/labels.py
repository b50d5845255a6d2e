"""Draws names and force arrows over a rendered picture, legible on any background."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from skillc_runtime.film.annotations import Annotations, ForceArrow
from skillc_runtime.film.camera import Projection

TAG_PIXELS, FORCE_PIXELS = 19, 26
"""Heights of letters in a picture of the size that is shown."""

ARROW_RGB = (186, 20, 130)
ARROW_PIXELS, HEAD_PIXELS = 7, 24
"""Width of the shaft of an arrow, length of its head."""

DARK, WHITE = (28, 32, 38), (255, 255, 255)


@cache
def load_font(pixels: int, bold: bool = False) -> Any:
    """Return DejaVu Sans, which comes with matplotlib, at a size in pixels."""
    import matplotlib

    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    return ImageFont.truetype(str(Path(matplotlib.get_data_path(), "fonts", "ttf", name)), pixels)


def draw_labels(image: Image.Image, annotations: Annotations, projection: Projection, scale: float) -> None:
    """Draw the names and arrows of a frame on an image that is `scale` times as large as it is shown."""
    draw = ImageDraw.Draw(image)
    for tag in annotations.tags:
        at = projection.pixel(tag.point)
        if at is not None:
            font, edge = load_font(round(TAG_PIXELS * scale)), round(2 * scale)
            draw.text(at, tag.text, DARK, font, anchor="mb", stroke_width=edge, stroke_fill=WHITE)
    for arrow in annotations.arrows:
        _draw_arrow(draw, arrow, projection, scale)


def _draw_arrow(draw: Any, arrow: ForceArrow, projection: Projection, scale: float) -> None:
    tail, tip = projection.pixel(arrow.tail), projection.pixel(arrow.tip)
    if tail is None or tip is None:
        return
    start, end = np.array(tail), np.array(tip)
    length = float(np.linalg.norm(end - start))
    along = (end - start) / length if length > 1.0 else np.array([0.0, 1.0])
    for grow, colour in ((2 * scale, WHITE), (0.0, ARROW_RGB)):
        draw.polygon(_outline(start, end, along, min(HEAD_PIXELS * scale, length), scale, grow), colour)
    font, beside = load_font(round(FORCE_PIXELS * scale), bold=True), np.array([14 * scale, 0.0])
    at = tuple(start + (beside if along[0] <= 0 else -beside))
    anchor = "lm" if along[0] <= 0 else "rm"
    draw.text(at, arrow.text, ARROW_RGB, font, anchor=anchor, stroke_width=round(3 * scale), stroke_fill=WHITE)


def _outline(start: Any, end: Any, along: Any, head: float, scale: float, grow: float) -> list[tuple[float, float]]:
    """Return the corners of an arrow, larger by `grow` pixels on each side."""
    across = np.array([-along[1], along[0]])
    half, wide, neck = ARROW_PIXELS * scale / 2 + grow, 0.5 * head + 1.6 * grow, end - head * along
    tip, back, neck = end + 2 * grow * along, start - grow * along, neck - grow * along
    corners = (
        back + half * across,
        neck + half * across,
        neck + wide * across,
        tip,
        neck - wide * across,
        neck - half * across,
        back - half * across,
    )
    return [(float(x), float(y)) for x, y in corners]
