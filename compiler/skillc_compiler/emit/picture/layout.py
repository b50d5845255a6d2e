"""Layout of boxes as an outline: every box on its own rows, children below their parent and indented."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from skillc_compiler.emit.picture.boxes import Look, PictureBox
from skillc_compiler.emit.picture.wrapping import count_cells, wrap_text

CELL = 7.5
"""Maximum width of a character, in pixels: monospaced fonts have 0.60 to 0.62 of their size, which is 12."""
LINE = 17
"""Line height, in pixels."""
SYMBOL = 28
"""Width of the field with the symbol, in pixels."""
PADDING = 8
INDENT = 30
GAP = 9
MARGIN = 8
WIDEST = 58
"""Maximum width of a line, in cells."""


class PlacedBox(msgspec.Struct, frozen=True):
    """A box with its position in pixels from the upper left corner; `parent` is where its connecting line starts."""

    look: Look
    symbol: str
    title: tuple[str, ...]
    lines: tuple[str, ...]
    called: str | None
    x: float
    y: float
    width: float
    height: float
    parent: tuple[float, float] | None


def lay_out(box: PictureBox) -> tuple[PlacedBox, ...]:
    """Return all boxes of a picture from top to bottom, parents before their children."""
    return tuple(_place(box, MARGIN, MARGIN, None))


def picture_size(placed: tuple[PlacedBox, ...]) -> tuple[int, int]:
    """Return the width and height of the picture in pixels."""
    right = max(each.x + each.width for each in placed)
    bottom = max(each.y + each.height for each in placed)
    return int(right) + MARGIN + 1, int(bottom) + MARGIN + 1


def _place(box: PictureBox, x: float, y: float, parent: tuple[float, float] | None) -> Iterator[PlacedBox]:
    title = wrap_text(box.title, WIDEST)
    lines = tuple(line for text in box.lines for line in wrap_text(text, WIDEST))
    longest = max(count_cells(line) for line in (*title, *lines))
    width = SYMBOL + 2 * PADDING + CELL * longest
    height = 2 * PADDING + LINE * (len(title) + len(lines)) - 3
    yield PlacedBox(box.look, box.symbol, title, lines, box.called, x, y, width, height, parent)
    knee = (x + SYMBOL / 2, y + height)
    below = y + height + GAP
    for child in box.children:
        for placed in _place(child, x + INDENT, below, knee):
            yield placed
            below = placed.y + placed.height + GAP
