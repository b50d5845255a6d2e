"""Lays out a document in lines (Wadler, A prettier printer, 1998, without laziness: one look-ahead for each group)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias, assert_never

from skillc_dsl.formatting import documents as d

WIDTH = 120
STEP = 4
GAP = 2


@dataclass(slots=True)
class Row:
    """A line: its indentation, its code, the comment at its end, and whether a blank line precedes it."""

    indent: int
    code: str
    remark: str = ""
    blank_before: bool = False

    @property
    def width(self) -> int:
        """The width in columns, without the comment."""
        return self.indent + len(self.code)


Pending: TypeAlias = tuple[int, bool, d.Document]
"""A document to lay out: its indentation, whether its soft breaks break, and the document."""


def lay_out(document: d.Document) -> list[Row]:
    """Return the lines of a document as new rows, which the caller may change."""
    page = _Page()
    pending: list[Pending] = [(0, True, document)]
    while pending:
        indent, breaks, part = pending.pop()
        match part:
            case d.Concatenation(parts=parts):
                pending.extend((indent, breaks, inner) for inner in reversed(parts))
            case d.Indent(body=body):
                pending.append((indent + STEP, breaks, body))
            case d.DocumentGroup(body=body):
                flat = not d.has_comment(body) and _fits(body, pending, WIDTH - page.column)
                pending.append((indent, not flat, body))
            case _:
                page.take(part, indent, breaks)
    return page.rows


def one_line(document: d.Document) -> str | None:
    """Return the text of a document on one line, or None if it does not fit or has a comment."""
    rows = lay_out(d.DocumentGroup(document))
    return rows[0].code if len(rows) == 1 and not rows[0].remark else None


def _fits(body: d.Document, pending: Sequence[Pending], room: int) -> bool:
    """Whether `body` without breaks, and the text after it up to the next break, fit in `room` columns."""
    for width, ends in _widths([*pending, (0, False, body)]):
        room -= width
        if room < 0 or ends:
            return room >= 0
    return True


def _widths(pending: list[Pending]) -> Iterator[tuple[int, bool]]:
    """Yield the width of each text in order, and whether the line ends there."""
    while pending:
        indent, breaks, part = pending.pop()
        match part:
            case d.Concatenation(parts=parts):
                pending.extend((indent, breaks, inner) for inner in reversed(parts))
            case d.Indent(body=inner) | d.DocumentGroup(body=inner):
                pending.append((indent, breaks, inner))
            case d.Fragment(text=text) | d.Punctuation(text=text):
                yield len(text), False
            case d.Gap():
                yield 1, False
            case d.SoftBreak(flat=flat):
                yield 0 if breaks else len(flat), breaks
            case d.HardBreak() | d.BlankLine() | d.TrailingComment() | d.CommentLine():
                yield 0, True
            case d.WhenBroken(text=text):
                yield len(text) if breaks else 0, False
            case _:
                assert_never(part)


class _Page:
    """The lines written so far. A line begins with its first text, so that no line is empty."""

    def __init__(self) -> None:
        self.rows: list[Row] = []
        self._start = 0
        self._open = False
        self._space = False
        self._blank = False

    @property
    def column(self) -> int:
        """The number of columns used in the current line."""
        return self.rows[-1].width + self._space if self._open else self._start

    def take(self, part: d.Leaf, indent: int, breaks: bool) -> None:
        """Write one leaf of a document."""
        match part:
            case d.Fragment(text=text):
                self._write(text, indent)
            case d.Gap():
                self._space = self._open
            case d.SoftBreak(flat=flat):
                self._line(flat, indent, breaks)
            case d.HardBreak():
                self._end(indent)
            case d.BlankLine():
                self._blank = True
            case d.TrailingComment(text=text):
                self.rows[-1].remark = text
            case d.CommentLine(text=text):
                self._note(text, indent)
            case d.Punctuation(text=text):
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
        """Whether a blank line is allowed here: not at the start of the file or of a block."""
        last = self.rows[-1].code if self.rows else "{"
        return last.startswith("#") or not last.endswith("{")

    def _note(self, text: str, indent: int) -> None:
        """Write a comment on its own line; the next line keeps the indentation of the interrupted one."""
        start = indent + STEP if self._open else self._start
        self._end(start)
        self._write(text, indent)
        self._end(start)


def render_rows(rows: Sequence[Row]) -> str:
    """Return the text of all rows, each with its comment."""
    return "".join(line for run in _runs(rows) for line in _lines(run))


def _runs(rows: Sequence[Row]) -> Iterator[list[Row]]:
    """Yield runs of rows with the same indentation and without blank lines between them."""
    run: list[Row] = []
    for row in rows:
        if run and (row.blank_before or row.indent != run[-1].indent):
            yield run
            run = []
        run.append(row)
    yield run


def _lines(run: Sequence[Row]) -> Iterator[str]:
    """Yield the lines of a run with aligned comments, or `GAP` columns after each line if one would be too long."""
    column = GAP + max((row.width for row in run if row.remark), default=0)
    aligned = all(column + len(row.remark) <= WIDTH for row in run)
    for row in run:
        blank = "\n" if row.blank_before else ""
        code = (" " * row.indent + row.code).rstrip()
        start = column if aligned else row.width + GAP
        yield f"{blank}{code:<{start}}{row.remark}\n" if row.remark else f"{blank}{code}\n"
