"""Text in lines of a limited width, counted in cells of a font whose characters are all as wide."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator

from skillc_dsl.rendering.printable import printable

INDENT = "  "
_BETWEEN = re.compile(r"(?<!:)\s+")


def count_cells(text: str) -> int:
    """Return how many cells a text takes; wide characters take two."""
    return sum(2 if unicodedata.east_asian_width(character) in "WF" else 1 for character in text)


def wrap_text(text: str, width: int) -> tuple[str, ...]:
    """Return the text in lines of at most `width` cells; it is cut after blanks, and in words that are longer.

    Lines after the first are indented; `width` is more than the indent and a wide character.
    """
    lines: list[str] = []
    line = ""
    for word in _words(printable(text), width - len(INDENT)):
        if line.strip() and count_cells(line) + count_cells(word) > width:
            lines.append(line.rstrip())
            line = INDENT
        line += f"{word} "
    return (*lines, line.rstrip())


def _words(text: str, width: int) -> Iterator[str]:
    """Yield the words, a name with the value after it as one, and those longer than `width` cells in pieces."""
    for word in _BETWEEN.split(text.strip()):
        piece = ""
        for character in word:
            if count_cells(piece) + count_cells(character) > width:
                yield piece
                piece = ""
            piece += character
        yield piece
