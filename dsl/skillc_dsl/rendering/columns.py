"""The width of text in a terminal: tabs, wide and combining characters, lines longer than the page."""

from __future__ import annotations

import unicodedata
from bisect import bisect_left, bisect_right
from dataclasses import dataclass
from functools import lru_cache

from skillc_dsl.rendering.printable import printable

TAB = 4
CUT = "…"
_REMEMBERED_LINES = 16
"""One long line may hold thousands of problems."""


@dataclass(frozen=True, slots=True)
class DisplayLine:
    """A line as a terminal shows it: `pieces` has the text for each character, `edges` the cell where each begins.

    The last of the edges is where the line ends.
    """

    pieces: tuple[str, ...]
    edges: tuple[int, ...]

    def edge(self, column: int) -> int:
        """Return the cell where a column (from 1) begins; columns beyond the end are one cell each."""
        index = max(column - 1, 0)
        return self.edges[index] if index < len(self.edges) else self.edges[-1] + index - len(self.pieces)


@dataclass(frozen=True, slots=True)
class Window:
    """What of a line is shown: its text, the cells cut off on the left, and where the text that is shown ends."""

    text: str
    shift: int
    end: int


@lru_cache(_REMEMBERED_LINES)
def lay_out(text: str) -> DisplayLine:
    """Return a line with its tabs as spaces up to the next stop and nothing in it that steers a terminal."""
    pieces: list[str] = []
    edges = [0]
    for character in printable(text):
        piece = " " * (TAB - edges[-1] % TAB) if character == "\t" else character
        pieces.append(piece)
        edges.append(edges[-1] + (len(piece) if character == "\t" else count_cells(character)))
    return DisplayLine(tuple(pieces), tuple(edges))


def count_cells(text: str) -> int:
    """Return how many cells a text takes in a terminal."""
    return sum(_cells(character) for character in text)


def clip_line(line: DisplayLine, start: int, end: int, width: int) -> Window:
    """Return up to `width` cells of a line around those from `start` to `end`, of which the start is shown at least."""
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
    """Return a piece that lies between `low` and `high`, spaces for the cells of one that is cut there."""
    if to > at and (at < low or to > high):
        return " " * max(0, min(to, high) - max(at, low))
    return piece if low <= at <= high else ""


def _cells(character: str) -> int:
    if unicodedata.category(character) in ("Mn", "Me", "Cf"):
        return 0
    return 2 if unicodedata.east_asian_width(character) in "WF" else 1
