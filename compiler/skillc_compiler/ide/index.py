"""The index of all occurrences of symbols in a program, on which most editor features are built."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping

import msgspec

from skillc_compiler.ide.declarations import FileOccurrences
from skillc_compiler.ide.symbols import ChoiceSymbol, Occurrence, Symbol
from skillc_compiler.ide.visible import VisibleNames
from skillc_compiler.program.program import Program
from skillc_dsl.source import Span
from skillc_model.conditions import Individual


class Index(msgspec.Struct, frozen=True):
    """Occurrences by file, in order of their places, and by symbol."""

    by_path: Mapping[str, tuple[Occurrence, ...]]
    by_symbol: Mapping[Symbol, tuple[Occurrence, ...]]

    def at(self, path: str, line: int, column: int) -> tuple[Occurrence, ...]:
        """Return the occurrences at a place, the narrowest first; a cursor right after a name counts as on it."""
        there = [o for o in self.by_path.get(path, ()) if covers(o, line, column)]
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
    values = _find_individuals(program)
    by_path: dict[str, tuple[Occurrence, ...]] = {}
    for unit in program.files:
        walk = FileOccurrences(visible[unit.file.path], program.skills, frozenset(labels))
        by_path[unit.file.path] = tuple(sorted((_chosen(o, values) for o in walk.file(unit)), key=lambda o: o.span))
    return Index(by_path, _by_symbol(occurrence for found in by_path.values() for occurrence in found))


def _chosen(occurrence: Occurrence, values: Mapping[Span, str]) -> Occurrence:
    """Return an occurrence of a bare value as that of the individual which it was resolved to."""
    symbol = occurrence.symbol
    if not isinstance(symbol, ChoiceSymbol) or symbol.iri or occurrence.span not in values:
        return occurrence
    return msgspec.structs.replace(occurrence, symbol=ChoiceSymbol(symbol.text, values[occurrence.span]))


def _find_individuals(program: Program) -> dict[Span, str]:
    """Return the values of enumerations that values were resolved to, by place."""
    if not program.vocabulary.enumerations:
        return {}
    found = ((value.span, value.meaning) for value in program.values)
    return {span: meaning.iri for span, meaning in found if isinstance(meaning, Individual)}


def covers(occurrence: Occurrence, line: int, column: int) -> bool:
    """Whether a place is on an occurrence, or right after it."""
    span = occurrence.span
    return span.line == line == span.end_line and span.column <= column <= span.end_column


def _by_symbol(occurrences: Iterable[Occurrence]) -> dict[Symbol, tuple[Occurrence, ...]]:
    found: dict[Symbol, list[Occurrence]] = defaultdict(list)
    for occurrence in occurrences:
        found[occurrence.symbol].append(occurrence)
    return {symbol: tuple(places) for symbol, places in found.items()}
