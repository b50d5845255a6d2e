"""Converts positions: editors count lines from 0 and columns in units of the negotiated encoding."""

from __future__ import annotations

from collections.abc import Mapping

from lsprotocol import types

from skillc_dsl.source import Span


def count_units(text: str, encoding: str) -> int:
    """Return the length of a text in UTF-8, UTF-16 or UTF-32 units."""
    if encoding == types.PositionEncodingKind.Utf8:
        return len(text.encode(errors="surrogatepass"))
    if encoding == types.PositionEncodingKind.Utf32:
        return len(text)
    return len(text) + sum(character > "\uffff" for character in text)


def column_at(line: str, character: int, encoding: str) -> int:
    """Return the column, from 1, of an editor's offset in a line; the line's end for an offset beyond it."""
    passed = 0
    for index, letter in enumerate(line):
        if passed >= character:
            return index + 1
        passed += count_units(letter, encoding)
    return len(line) + 1


class PositionConverter:
    """Converts between spans and editor positions, given the texts of the files."""

    def __init__(self, texts: Mapping[str, str], encoding: str) -> None:
        self._texts = texts
        self._encoding = encoding
        self._lines: dict[str, list[str]] = {}

    def place(self, path: str, position: types.Position) -> tuple[int, int]:
        """Return line and column, from 1, of an editor's position."""
        return position.line + 1, column_at(self._line(path, position.line + 1), position.character, self._encoding)

    def range(self, span: Span) -> types.Range:
        """Return an editor's range for a span."""
        return types.Range(
            self._position(span.path, span.line, span.column), self._position(span.path, span.end_line, span.end_column)
        )

    def _position(self, path: str, line: int, column: int) -> types.Position:
        return types.Position(line - 1, count_units(self._line(path, line)[: column - 1], self._encoding))

    def _line(self, path: str, number: int) -> str:
        if path not in self._lines:
            self._lines[path] = self._texts.get(path, "").split("\n")
        lines = self._lines[path]
        return lines[number - 1] if 0 < number <= len(lines) else ""
