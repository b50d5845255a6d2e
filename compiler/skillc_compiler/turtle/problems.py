"""What is wrong with a Turtle file, as data: places, words, causes and cures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True, slots=True, order=True)
class Place:
    """A stretch of a file. Lines and columns count characters from 1; the end column is exclusive."""

    path: str
    line: int
    column: int
    end_line: int
    end_column: int


@dataclass(frozen=True, slots=True)
class Note:
    """A second place that explains the first."""

    place: Place
    message: str


@dataclass(frozen=True, slots=True)
class Edit:
    """An edit that cures the problem: put `text` where `place` is."""

    place: Place
    text: str
    message: str


@dataclass(frozen=True, slots=True)
class Problem:
    """A mistake in a Turtle file: where, its name, what is wrong, what to do, and what else explains it."""

    place: Place
    name: str
    message: str
    help: str = ""
    notes: tuple[Note, ...] = ()
    edit: Edit | None = None
    severity: Literal["error", "warning"] = "error"

    @property
    def path(self) -> str:
        """The file."""
        return self.place.path

    @property
    def line(self) -> int:
        """The first line."""
        return self.place.line

    @property
    def column(self) -> int:
        """The first column."""
        return self.place.column

    def __str__(self) -> str:
        where = f"{self.place.path}:{self.place.line}:{self.place.column}"
        return f"{where}: {self.message}" + (f" ({self.help})" if self.help else "")
