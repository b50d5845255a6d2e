"""Draws the strip below each picture of a film: the step, the force, the time, and at the end how the run ended."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from skillc_runtime.film.labels import load_font

STRIP_WIDTH, STRIP_PIXELS = 1280, 88
"""Width and height of the strip of a film of that width; others are in proportion."""

EDGE, LARGE, SMALL = 24, 31, 22
"""Free pixels at the left and right, and heights of letters."""

BACKGROUND, TEXT, DIM, FORCE = (30, 34, 40), (255, 255, 255), (190, 198, 208), (255, 150, 215)
ENDINGS = {"succeeded": (30, 84, 56), "unverified": (96, 78, 28), "failed": (122, 38, 30), "stopped": (70, 74, 84)}
"""Colours of the strip once a run has ended so."""

EndKind: TypeAlias = Literal["succeeded", "unverified", "failed", "stopped"]


@dataclass(frozen=True, slots=True)
class Caption:
    """What was done from `start` to `end`, in s of the cell's clock."""

    text: str
    start: float
    end: float


@dataclass(frozen=True, slots=True)
class FilmEnding:
    """How a run ended: its colour, and what is said."""

    kind: EndKind
    text: str


@dataclass(frozen=True, slots=True)
class StripText:
    """The text of a strip: two lines at the left, two at the right; the upper one there is a force."""

    large: str
    small: str = ""
    force: str = ""
    time: str = ""
    ending: EndKind | None = None


def caption_at(captions: Sequence[Caption], time: float) -> str:
    """Return what was done at a time in s; what is done at once is joined."""
    return "  +  ".join(each.text for each in captions if each.start <= time < each.end)


@lru_cache(maxsize=64)
def draw_strip(text: StripText, width: int) -> NDArray[np.uint8]:
    """Return the strip (n, width, 3) of a film; n and its letters are in proportion to those of STRIP_WIDTH."""
    scale = width / STRIP_WIDTH
    height, edge, large, small = (round(scale * each) for each in (STRIP_PIXELS, EDGE, LARGE, SMALL))
    image = Image.new("RGB", (width, height), BACKGROUND if text.ending is None else ENDINGS[text.ending])
    draw = ImageDraw.Draw(image)
    upper, lower = height * 0.33, height * 0.74
    first = upper if text.small else height / 2
    draw.text((width - edge, upper), text.force, FORCE, load_font(large, bold=True), anchor="rm")
    draw.text((width - edge, lower), text.time, DIM, load_font(small), anchor="rm")
    beside = draw.textlength(text.force, load_font(large, bold=True))
    if not text.small:  # the line is in the middle, beside both at the right
        beside = max(beside, draw.textlength(text.time, load_font(small)))
    room = width - 3 * edge - beside
    shown = shorten(draw, text.large, room, large, True)
    draw.text((edge, first), shown, TEXT, load_font(large, bold=True), anchor="lm")
    room = width - 3 * edge - draw.textlength(text.time, load_font(small))
    draw.text((edge, lower), shorten(draw, text.small, room, small, False), DIM, load_font(small), anchor="lm")
    return np.asarray(image)


def shorten(draw: Any, text: str, room: float, pixels: int, bold: bool) -> str:
    """Return as much of a text as there is room for, in pixels, with an ellipsis if it is not all."""
    font = load_font(pixels, bold)
    if draw.textlength(text, font) <= room:
        return text
    while text and draw.textlength(text + "…", font) > room:
        text = text[:-1]
    return text.rstrip() + "…"
