"""Excerpts of source with the places of a problem underlined."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from itertools import groupby
from typing import NamedTuple

from skillc_dsl.rendering.columns import DisplayLine, Window, clip_line, lay_out
from skillc_dsl.rendering.paint import Kind, Paint
from skillc_dsl.rendering.printable import printable
from skillc_dsl.source import Source, Span

_WIDTH = 160
"""The width in cells if none is given."""
_NARROWEST = 24
"""The minimum room in cells for a message beside its carets; with less room it is put below them."""


class Underline(NamedTuple):
    """A place to underline, with its message."""

    span: Span
    message: str
    kind: Kind


class ExcerptLayout(NamedTuple):
    """The layout of excerpts: colours, width in cells (None if unlimited), digits of line numbers."""

    paint: Paint
    width: int | None
    digits: int

    def gutter(self, text: object = "") -> str:
        """Return the left margin of a line, with its number or the text in place of it."""
        return f"{text:>{self.digits}} {self.paint('place', '|')}"

    @property
    def room(self) -> int:
        """The number of cells to the right of the margin."""
        return max((self.width or _WIDTH) - self.digits - 3, _NARROWEST)


def render_excerpt(source: Source | None, marks: Sequence[Underline], arrow: str, page: ExcerptLayout) -> Iterator[str]:
    """Yield the place of the first mark, and below it the marked lines of the file unless `source` is None."""
    first = marks[0].span
    place = f"{' ' * page.digits}{page.paint('place', arrow)} {printable(first.path)}:{first.line}:{first.column}"
    text = _split(source.text) if source else ()
    known = [mark for mark in marks if mark.span.line <= len(text)]
    if not known:
        yield place + (f": {printable(marks[0].message)}" if marks[0].message else "")
        return
    yield place
    yield page.gutter()
    yield from _lines(text, known, page)


@lru_cache(4)
def _split(text: str) -> tuple[str, ...]:
    """Return the lines of a text; cached, since one text may have many excerpts."""
    return tuple(text.split("\n"))


def _lines(text: Sequence[str], marks: Iterable[Underline], page: ExcerptLayout) -> Iterator[str]:
    """Yield the marked lines in order; a gap of one line is shown, a longer one is replaced by dots."""
    previous = 0
    by_line = sorted(marks, key=lambda mark: mark.span.line)
    for number, group in groupby(by_line, key=lambda mark: mark.span.line):
        if previous and number - previous == 2:
            yield from _line(text, number - 1, (), page)
        elif previous and number - previous > 2:
            yield page.paint("place", "...")
        yield from _line(text, number, tuple(group), page)
        previous = number


def _line(text: Sequence[str], number: int, marks: Sequence[Underline], page: ExcerptLayout) -> Iterator[str]:
    """Yield one line, clipped around its first mark if it is too long, and a row below it for each mark."""
    written = text[number - 1].rstrip("\r")
    line = lay_out(written)
    edges = [_edges(line, mark.span, len(written)) for mark in marks]
    start, end = edges[0] if edges else (0, 0)
    shown = clip_line(line, start, end, page.room)
    yield f"{page.gutter(number)} {shown.text}".rstrip()
    for mark, (start, end) in zip(marks, edges, strict=True):
        yield from _row(mark, start, end, shown, page)


def _edges(line: DisplayLine, span: Span, length: int) -> tuple[int, int]:
    """Return the cells where a mark begins and ends on its first line."""
    end = span.end_column if span.end_line == span.line else length + 1
    return line.edge(span.column), max(line.edge(end), line.edge(span.column) + 1)


def _row(mark: Underline, start: int, end: int, shown: Window, page: ExcerptLayout) -> Iterator[str]:
    """Yield the carets of a mark, with its message beside them or, without enough room, below them."""
    indent = min(max(0, start - shown.shift), page.room - 1)
    sign = "-" if mark.kind == "label" else "^"
    carets = sign * max(1, min(end, shown.end) - shown.shift - indent)
    message = printable(mark.message)
    beside = page.room - indent - len(carets) - 1
    if page.width is None or len(message) <= max(beside, 0):
        rows = [" ".join(filter(None, (carets, message)))]
    elif beside >= _NARROWEST:
        first, *rest = textwrap.wrap(message, beside, break_long_words=False, break_on_hyphens=False)
        rows = [f"{carets} {first}", *(f"{' ' * len(carets)} {row}" for row in rest)]
    else:
        yield f"{page.gutter()} {' ' * indent}{page.paint(mark.kind, carets)}"
        indent = min(indent, max(0, page.room - max(len(message), 1)), page.room // 2)
        rows = textwrap.wrap(message, page.room - indent, break_long_words=False, break_on_hyphens=False)
    for row in rows:
        yield f"{page.gutter()} {' ' * indent}{page.paint(mark.kind, row)}"
