"""Wraps text to lines of limited width, in cells of a monospaced font."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator

from skillc_dsl.rendering.printable import printable

INDENT = "  "
_BETWEEN = re.compile(r"(?<!:)\s+")


def count_cells(text: str) -> int:
    """Return the width of a text in cells; wide characters take two."""
    return sum(2 if unicodedata.east_asian_width(character) in "WF" else 1 for character in text)


def wrap_text(text: str, width: int) -> tuple[str, ...]:
    """Return the text in lines of at most `width` cells, broken at blanks and within words longer than a line.

    Lines after the first are indented; `width` must exceed the indent plus a wide character.
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
    """Yield the words; a name and the value after it are one word, words longer than `width` cells are split."""
    for word in _BETWEEN.split(text.strip()):
        piece = ""
        for character in word:
            if count_cells(piece) + count_cells(character) > width:
                yield piece
                piece = ""
            piece += character
        yield piece
