"""Lays out text for a page of some width: wrapped paragraphs, columns with hanging indents, tables of numbers.

Words are never broken, so that names, IRIs and paths can be copied, and no line ends with blanks.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from typing import Literal, NamedTuple, TypeAlias

from skillc_dsl.rendering.columns import count_cells
from skillc_dsl.rendering.printable import printable

Style: TypeAlias = Literal["", "strong", "dim", "name", "good", "bad", "warning"]
_CODES: dict[Style, str] = {"strong": "1", "dim": "2", "name": "36", "good": "1;32", "bad": "1;31", "warning": "33"}

GAP = "  "
LEAST_CELLS = 24
"""The least width of a last column; where there is less room, it goes below the others."""

_WORD = re.compile(r"\s*\S+")


class TableCell(NamedTuple):
    """A text in a column, and how it looks."""

    text: str
    style: Style = ""


Row: TypeAlias = Sequence[TableCell | str]


class TerminalPage(NamedTuple):
    """Where text is printed: its width in cells, None if nothing is to be wrapped, and whether it has colours."""

    width: int | None = None
    colour: bool = False

    def paint(self, text: str, style: Style) -> str:
        """Return a text in a style, unchanged on a page without colours."""
        return f"\x1b[{_CODES[style]}m{text}\x1b[0m" if self.colour and style and text else text

    def wrap(self, text: str, style: Style = "", indent: str = "", hanging: str | None = None) -> list[str]:
        """Return a text as lines that begin with `indent`; those that continue one begin with `hanging`, if given."""
        rest = indent if hanging is None else hanging
        lines: list[str] = []
        for paragraph in printable(text).split("\n"):
            lines += (
                f"{rest if number else indent}{self.paint(line, style)}".rstrip()
                for number, line in enumerate(self._fill(paragraph, count_cells(indent), count_cells(rest)))
            )
        return lines

    def columns(self, rows: Sequence[Row], indent: str = "") -> list[str]:
        """Return rows of cells as lines; the last column is wrapped within itself.

        A row whose first cells are wider than half of the page has its last cell below them.
        """
        table = [[_cell(each) for each in row] for row in rows]
        if not table:
            return []
        widths = self._column_widths(table, count_cells(indent))
        return [line for row in table for line in self._row(row, widths, indent)]

    def table(self, header: Sequence[str], rows: Sequence[Row], right: Collection[int] = ()) -> list[str]:
        """Return a table whose columns with an index in `right` are aligned to the right.

        On a page that is too narrow for it, each row is a paragraph: its first cell, then the others by their names.
        """
        cells = [[_cell(each) for each in row] for row in rows]
        if not self.has_room(header, rows):
            return [line for row in cells for line in self._record(header, row)]
        widths = _table_widths(header, cells)
        lines = [[TableCell(name, "dim") for name in header], *cells]
        return [self._table_line(row, widths, right) for row in lines]

    def has_room(self, header: Sequence[str], rows: Sequence[Row]) -> bool:
        """Whether a table fits on the page."""
        widths = _table_widths(header, [[_cell(each) for each in row] for row in rows])
        return self.width is None or sum(widths) + len(GAP) * (len(widths) - 1) <= self.width

    def _fill(self, text: str, first: int, others: int) -> Iterator[str]:
        """Yield a paragraph in lines that leave room for an indent of `first` cells, then of `others`."""
        if self.width is None or first + count_cells(text.rstrip()) <= self.width:
            yield text.rstrip()
            return
        line, room = "", self.width - first
        for word in _WORD.findall(text.rstrip()):
            if line and count_cells(line + word) > room:
                yield line
                line, room = "", self.width - others
            line += word if line or not room else word.lstrip()
        yield line

    def _column_widths(self, rows: Sequence[Sequence[TableCell]], indent: int) -> list[int]:
        """Return the widths of all columns but the last; rows that are too wide for half of the page do not count."""
        half = None if self.width is None else (self.width - indent) // 2
        heads = [[count_cells(each.text) for each in row[:-1]] for row in rows]
        fitting = [head for head in heads if half is None or sum(head) + len(GAP) * len(head) <= half]
        return [max(column) for column in zip(*(fitting or [[0] * len(heads[0])]), strict=True)]

    def _row(self, row: Sequence[TableCell], widths: Sequence[int], indent: str) -> Iterator[str]:
        *head, last = row
        begin = indent + "".join(f"{' ' * width}{GAP}" for width in widths)
        fits = all(count_cells(each.text) <= width for each, width in zip(head, widths, strict=True))
        if fits and self._has_cells(last.text, count_cells(begin)):
            first, *rest = self.wrap(last.text, last.style, begin) or [""]
            shown = (self._pad(each, width) + GAP for each, width in zip(head, widths, strict=True))
            yield (indent + "".join(shown) + first[len(begin) :]).rstrip()
            yield from rest
            return
        below = min(begin, indent + " " * 4, key=len) if any(widths) else indent + " " * 4
        yield (indent + GAP.join(self.paint(printable(each.text.rstrip()), each.style) for each in head)).rstrip()
        yield from self.wrap(last.text, last.style, below) if last.text else ()

    def _has_cells(self, text: str, begin: int) -> bool:
        """Whether a text can be wrapped in the last column, which begins at a cell, without being too narrow for it."""
        longest = max(map(count_cells, text.split()), default=0)
        return self.width is None or self.width - begin >= max(LEAST_CELLS, min(longest, self.width - 4))

    def _table_line(self, row: Sequence[TableCell], widths: Sequence[int], right: Collection[int]) -> str:
        cells = (
            self._pad(each, width, column in right)
            for column, (each, width) in enumerate(zip(row, widths, strict=True))
        )
        return GAP.join(cells).rstrip()

    def _record(self, header: Sequence[str], row: Sequence[TableCell]) -> Iterator[str]:
        yield from self.wrap(row[0].text, row[0].style, hanging=" " * 4)
        pairs = [(TableCell(name, "dim"), each) for name, each in zip(header[1:], row[1:], strict=True) if each.text]
        yield from self.columns(pairs, " " * 4)

    def _pad(self, cell: TableCell, width: int, right: bool = False) -> str:
        text = printable(cell.text)
        blanks = " " * (width - count_cells(text))
        return f"{blanks}{self.paint(text, cell.style)}" if right else f"{self.paint(text, cell.style)}{blanks}"


def _table_widths(header: Sequence[str], rows: Sequence[Sequence[TableCell]]) -> list[int]:
    lines = [[TableCell(name) for name in header], *rows]
    return [max(count_cells(row[column].text) for row in lines) for column in range(len(header))]


def _cell(value: TableCell | str) -> TableCell:
    return value if isinstance(value, TableCell) else TableCell(value)
