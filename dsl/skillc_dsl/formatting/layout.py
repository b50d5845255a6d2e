"""Lays a document out in lines (Wadler, A prettier printer, 1998, without laziness: one look ahead for each group)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias, assert_never

from skillc_dsl.formatting import documents as d

WIDTH = 120
STEP = 4


@dataclass(slots=True)
class Row:
    """A line: its indentation, what stands there, the comment at its end, and whether a blank line precedes it."""

    indent: int
    code: str
    remark: str = ""
    blank_before: bool = False

    @property
    def width(self) -> int:
        """Columns without the comment."""
        return self.indent + len(self.code)


Pending: TypeAlias = tuple[int, bool, d.Document]
"""A document yet to be laid out: its indentation, whether its lines break, and itself."""


def lay_out(document: d.Document) -> list[Row]:
    """Return the lines of a document. The rows are new, and the caller's."""
    page = _Page()
    pending: list[Pending] = [(0, True, document)]
    while pending:
        indent, breaks, part = pending.pop()
        match part:
            case d.Joined(parts=parts):
                pending.extend((indent, breaks, inner) for inner in reversed(parts))
            case d.Nest(body=body):
                pending.append((indent + STEP, breaks, body))
            case d.Group(body=body):
                flat = not d.has_comment(body) and _fits(body, pending, WIDTH - page.column)
                pending.append((indent, not flat, body))
            case _:
                page.take(part, indent, breaks)
    return page.rows


def one_line(document: d.Document) -> str | None:
    """Return the text of a document without comments that fits one line, None for any other."""
    rows = lay_out(d.Group(document))
    return rows[0].code if len(rows) == 1 and not rows[0].remark else None


def _fits(body: d.Document, pending: Sequence[Pending], room: int) -> bool:
    """Whether `body`, flat, and what follows it up to the next break stay within `room` columns."""
    for width, ends in _widths([*pending, (0, False, body)]):
        room -= width
        if room < 0 or ends:
            return room >= 0
    return True


def _widths(pending: list[Pending]) -> Iterator[tuple[int, bool]]:
    """Yield the widths of texts in their order, and whether the line ends there."""
    while pending:
        indent, breaks, part = pending.pop()
        match part:
            case d.Joined(parts=parts):
                pending.extend((indent, breaks, inner) for inner in reversed(parts))
            case d.Nest(body=inner) | d.Group(body=inner):
                pending.append((indent, breaks, inner))
            case d.Text(text=text) | d.Mark(text=text):
                yield len(text), False
            case d.Space():
                yield 1, False
            case d.Line(flat=flat):
                yield 0 if breaks else len(flat), breaks
            case d.NewLine() | d.Blank() | d.Remark() | d.Note():
                yield 0, True
            case d.WhenBroken(text=text):
                yield len(text) if breaks else 0, False
            case _:
                assert_never(part)


class _Page:
    """Lines as they grow. A line begins with its first text, so that no line is empty."""

    def __init__(self) -> None:
        self.rows: list[Row] = []
        self._start = 0
        self._open = False
        self._space = False
        self._blank = False

    @property
    def column(self) -> int:
        """How many columns of the line are taken."""
        return self.rows[-1].width + self._space if self._open else self._start

    def take(self, part: d.Leaf, indent: int, breaks: bool) -> None:
        """Write one part that has no parts of its own."""
        match part:
            case d.Text(text=text):
                self._write(text, indent)
            case d.Space():
                self._space = self._open
            case d.Line(flat=flat):
                self._line(flat, indent, breaks)
            case d.NewLine():
                self._end(indent)
            case d.Blank():
                self._blank = True
            case d.Remark(text=text):
                self.rows[-1].remark = text
            case d.Note(text=text):
                self._note(text, indent)
            case d.Mark(text=text):
                self.rows[-1].code += text
            case d.WhenBroken(text=text):
                self.rows[-1].code += text if breaks else ""
            case _:
                assert_never(part)

    def _line(self, flat: str, indent: int, breaks: bool) -> None:
        if breaks:
            self._end(indent)
        else:
            self._space = self._open and bool(flat)

    def _end(self, indent: int) -> None:
        self._open, self._space, self._start = False, False, indent

    def _write(self, text: str, indent: int) -> None:
        if self._open and self.rows[-1].remark:
            self._end(indent + STEP)
        if not self._open:
            self.rows.append(Row(self._start, "", blank_before=self._blank and self._may_be_blank()))
            self._open, self._blank = True, False
        self.rows[-1].code += f" {text}" if self._space else text
        self._space = False

    def _may_be_blank(self) -> bool:
        """Whether a blank line may follow: neither at the start of the file nor at that of a block."""
        last = self.rows[-1].code if self.rows else "{"
        return last.startswith("#") or not last.endswith("{")

    def _note(self, text: str, indent: int) -> None:
        """Write a comment on its own line; what follows it goes on as far indented."""
        start = indent + STEP if self._open else self._start
        self._end(start)
        self._write(text, indent)
        self._end(start)
