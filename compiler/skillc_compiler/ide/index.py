"""The index of all occurrences of symbols in a program, on which most editor features are built."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping

import msgspec

from skillc_compiler.ide.declarations import FileOccurrences
from skillc_compiler.ide.symbols import Occurrence, Symbol
from skillc_compiler.ide.visible import VisibleNames
from skillc_compiler.program.typed import Program


class Index(msgspec.Struct, frozen=True):
    """Occurrences by file, in order of their places, and by symbol."""

    by_path: Mapping[str, tuple[Occurrence, ...]]
    by_symbol: Mapping[Symbol, tuple[Occurrence, ...]]

    def at(self, path: str, line: int, column: int) -> tuple[Occurrence, ...]:
        """Return the occurrences at a place, the narrowest first; a cursor right after a name counts as on it."""
        there = [o for o in self.by_path.get(path, ()) if _covers(o, line, column)]
        return tuple(sorted(there, key=lambda o: (o.span.end_column - o.span.column, o.span.column != column)))

    def of(self, symbol: Symbol) -> tuple[Occurrence, ...]:
        """Return all occurrences of a symbol."""
        return self.by_symbol.get(symbol, ())

    def declarations(self, symbol: Symbol) -> Iterator[Occurrence]:
        """Yield the occurrences that declare a symbol."""
        return (occurrence for occurrence in self.of(symbol) if occurrence.declares)


def build_index(program: Program, visible: Mapping[str, VisibleNames]) -> Index:
    """Return the index of a program; `visible` are the visible names by path of the file."""
    labels = {
        (name, label.text)
        for name, skill in program.skills.items()
        for label in (r.label for r in skill.requirements)
        if label
    }
    by_path: dict[str, tuple[Occurrence, ...]] = {}
    for unit in program.files:
        walk = FileOccurrences(visible[unit.file.path], program.skills, frozenset(labels))
        by_path[unit.file.path] = tuple(sorted(walk.file(unit), key=lambda o: o.span))
    return Index(by_path, _by_symbol(occurrence for found in by_path.values() for occurrence in found))


def _covers(occurrence: Occurrence, line: int, column: int) -> bool:
    span = occurrence.span
    return span.line == line == span.end_line and span.column <= column <= span.end_column


def _by_symbol(occurrences: Iterable[Occurrence]) -> dict[Symbol, tuple[Occurrence, ...]]:
    found: dict[Symbol, list[Occurrence]] = defaultdict(list)
    for occurrence in occurrences:
        found[occurrence.symbol].append(occurrence)
    return {symbol: tuple(places) for symbol, places in found.items()}
