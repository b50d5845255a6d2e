"""Source texts and places in them."""

from __future__ import annotations

from typing import NamedTuple

from skillc_dsl.editions import NEWEST
from skillc_dsl.position import Position


class Source(NamedTuple):
    """The text of a file and the path that diagnostics show.

    `unreadable` are the offsets of U+FFFD that stand for bytes that are not UTF-8; any other one is in the file.
    `edition` is that of the library of the file.
    """

    path: str
    text: str
    unreadable: tuple[int, ...] = ()
    edition: int = NEWEST


class Span(NamedTuple):
    """A range of text. Lines and columns count from 1; the end column is exclusive."""

    path: str
    line: int
    column: int
    end_line: int
    end_column: int

    def to(self, end: Span) -> Span:
        """Return the span from the start of this one to the end of `end`, in the same file."""
        return Span(self.path, self.line, self.column, end.end_line, end.end_column)

    def gap(self, next_: Span) -> Span:
        """Return the span between this one and a later one."""
        return Span(self.path, self.end_line, self.end_column, next_.line, next_.column)

    def begins_in(self, other: Span) -> bool:
        """Whether this span starts within another one of the same file."""
        return (other.line, other.column) <= (self.line, self.column) < (other.end_line, other.end_column)

    @property
    def start(self) -> Position:
        """The position where this one begins."""
        return Position(self.path, self.line, self.column)

    @property
    def after(self) -> Span:
        """The empty span where this one ends."""
        return Span(self.path, self.end_line, self.end_column, self.end_line, self.end_column)
