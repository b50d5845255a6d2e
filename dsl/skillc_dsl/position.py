"""Positions in source files: all that a compiled library and a running task know of the text they come from."""

from __future__ import annotations

import msgspec


class Position(msgspec.Struct, frozen=True, order=True):
    """A position in a file: path relative to the library (or `std/..`), line and column from 1."""

    path: str
    line: int
    column: int

    def __str__(self) -> str:
        return f"{self.path}:{self.line}"
