"""Finds the places of keys in a TOML text, which `tomllib` does not tell."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from skillc_dsl.source import Source, Span

_PART = r"(?:[\w-]+|\"[^\"]*\"|'[^']*')"
_DOTTED = rf"{_PART}(?:\s*\.\s*{_PART})*"
_HEADER = re.compile(rf"\s*\[\[?\s*(?P<keys>{_DOTTED})\s*\]")
_KEY = re.compile(rf"\s*(?P<keys>{_DOTTED})\s*=")


class TomlPlaces:
    """The places of the keys of a text that is valid TOML."""

    def __init__(self, source: Source) -> None:
        self._path, self._lines = source.path, source.text.split("\n")
        self._places = dict(reversed(list(self._read())))

    def find(self, keys: Sequence[str]) -> Span:
        """Return the place of a key, such as `("tool", "run", "seed")`: itself, or the nearest table that has it."""
        for length in range(len(keys), 0, -1):
            place = self._places.get(tuple(keys[:length]))
            if place is not None:
                return self._within(place, keys[length:]) if length < len(keys) else place
        return Span(self._path, 1, 1, 1, 2)

    def _read(self) -> Iterator[tuple[tuple[str, ...], Span]]:
        table: tuple[str, ...] = ()
        for number, line in enumerate(self._lines, 1):
            header, key = _HEADER.match(line), _KEY.match(line)
            found = header or key
            if found is None:
                continue
            keys = (*(() if header else table), *_split(found["keys"]))
            table = keys if header else table
            yield keys, Span(self._path, number, found.start("keys") + 1, number, found.end("keys") + 1)

    def _within(self, outer: Span, keys: Sequence[str]) -> Span:
        """Return the place of a key of an inline table in the line of `outer`, or `outer`."""
        line = self._lines[outer.line - 1]
        found = re.compile(rf"(?<![\w-]){re.escape(keys[-1])}(?=[\"']?\s*=)").search(line, outer.end_column - 1)
        return outer if found is None else Span(self._path, outer.line, found.start() + 1, outer.line, found.end() + 1)


def _split(dotted: str) -> tuple[str, ...]:
    return tuple(part.strip("\"'") for part in re.findall(_PART, dotted))
