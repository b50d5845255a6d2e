"""The width of text in a terminal: tabs, wide and combining characters, lines longer than the page."""

from __future__ import annotations

import unicodedata
from bisect import bisect_left, bisect_right
from functools import lru_cache
from typing import NamedTuple

from skillc_dsl.rendering.printable import printable

TAB = 4
CUT = "…"
_REMEMBERED_LINES = 16
"""The size of the cache: a long line may have thousands of problems and is laid out once."""


class DisplayLine(NamedTuple):
    """A line as shown in a terminal: `pieces` has the text for each character, `edges` the cell where each begins.

    The last edge is the end of the line.
    """

    pieces: tuple[str, ...]
    edges: tuple[int, ...]

    def edge(self, column: int) -> int:
        """Return the cell where a column (from 1) begins; columns after the end of the line are one cell each."""
        index = max(column - 1, 0)
        return self.edges[index] if index < len(self.edges) else self.edges[-1] + index - len(self.pieces)


class Window(NamedTuple):
    """The visible part of a line: its text, the number of cells cut off on the left, and the cell where it ends."""

    text: str
    shift: int
    end: int


@lru_cache(_REMEMBERED_LINES)
def lay_out(text: str) -> DisplayLine:
    """Return a line with tabs expanded to spaces and control characters replaced."""
    shown = printable(text)
    if _is_plain(shown):
        return DisplayLine(tuple(shown), tuple(range(len(shown) + 1)))
    pieces: list[str] = []
    edges = [0]
    for character in shown:
        piece = " " * (TAB - edges[-1] % TAB) if character == "\t" else character
        pieces.append(piece)
        edges.append(edges[-1] + (len(piece) if character == "\t" else count_cells(character)))
    return DisplayLine(tuple(pieces), tuple(edges))


def count_cells(text: str) -> int:
    """Return the number of cells that a text takes in a terminal."""
    return len(text) if _is_plain(text) else sum(map(_cells, text))


def clip_line(line: DisplayLine, start: int, end: int, width: int) -> Window:
    """Return up to `width` cells of a line around the cells from `start` to `end`; `start` is always visible."""
    last = line.edges[-1]
    if last <= width:
        return Window("".join(line.pieces), 0, last)
    spare = max(width - (end - start), 2 * width // 3)
    left = max(0, min(start - spare // 2, last - width)) if end > width - 1 else 0
    head, tail = (1 if left else 0), (1 if left + width < last else 0)
    low, high = left + head, left + width - tail
    first, after = max(bisect_left(line.edges, low) - 1, 0), bisect_right(line.edges, high)
    shown = zip(line.pieces[first:after], line.edges[first:], line.edges[first + 1 :], strict=False)
    kept = "".join(_part(piece, at, to, low, high) for piece, at, to in shown)
    return Window(CUT * head + kept + CUT * tail, left, high)


def _part(piece: str, at: int, to: int, low: int, high: int) -> str:
    """Return a piece if it lies between `low` and `high`; a piece cut at an edge is replaced by spaces."""
    if to > at and (at < low or to > high):
        return " " * max(0, min(to, high) - max(at, low))
    return piece if low <= at <= high else ""


def _is_plain(text: str) -> bool:
    """Whether each character takes one cell, certainly."""
    return text.isascii() and text.isprintable()


def _cells(character: str) -> int:
    if unicodedata.category(character) in ("Mn", "Me", "Cf"):
        return 0
    return 2 if unicodedata.east_asian_width(character) in "WF" else 1
