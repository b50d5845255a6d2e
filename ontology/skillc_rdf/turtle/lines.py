"""Finds the line and column of an offset in a text."""

from __future__ import annotations

import re
from bisect import bisect_right

from skillc_dsl.source import Span


class Lines:
    """Converts offsets in a text to spans."""

    def __init__(self, path: str, text: str) -> None:
        self.path = path
        self._starts = [0, *(match.end() for match in re.finditer("\n", text))]

    def place(self, start: int, end: int) -> Span:
        """Return the span between two offsets."""
        return Span(self.path, *self._position(start), *self._position(end))

    def line(self, offset: int) -> int:
        """Return the line of an offset, from 1."""
        return bisect_right(self._starts, offset)

    def _position(self, offset: int) -> tuple[int, int]:
        line = self.line(offset)
        return line, offset - self._starts[line - 1] + 1
