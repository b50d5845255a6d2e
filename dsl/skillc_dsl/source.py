"""Source text and places in it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Source:
    """A file's text under the path that diagnostics show."""

    path: str
    text: str


@dataclass(frozen=True, slots=True, order=True)
class Span:
    """A stretch of text. Lines and columns count from 1; the end column is exclusive."""

    path: str
    line: int
    column: int
    end_line: int
    end_column: int

    def to(self, end: Span) -> Span:
        """Return the span from this one's start to the end of `end`, in the same file."""
        return Span(self.path, self.line, self.column, end.end_line, end.end_column)
