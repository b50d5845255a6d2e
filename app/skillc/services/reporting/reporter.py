"""The protocol through which services report messages, and helpers that prepare diagnostics for display."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Protocol

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.encoding import decode, read_file
from skillc_dsl.source import Source


class Reporter(Protocol):
    """Receives the messages and warnings of a service while it works."""

    def say(self, message: str) -> None:
        """Report one line, such as `warning: ..`."""
        ...

    def show(self, diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source]) -> None:
        """Report diagnostics; `texts` are the files that they point into, by path."""
        ...


class SilentReporter:
    """A reporter that discards everything."""

    def say(self, message: str) -> None:
        """Do nothing."""

    def show(self, diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source]) -> None:
        """Do nothing."""


def sort_diagnostics(diagnostics: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Return each diagnostic once, sorted by span and name."""
    return tuple(sorted(set(diagnostics), key=lambda each: (each.span, each.name)))


def find_texts(diagnostics: Iterable[Diagnostic], known: Mapping[str, Source]) -> dict[str, Source]:
    """Return the texts of all files that diagnostics point into, from `known` or else from disk."""
    spans = (span for each in diagnostics for span in (each.span, *(label.span for label in each.labels)))
    found = {path: known.get(path) or _read(path) for path in sorted({span.path for span in spans})}
    return {path: source for path, source in found.items() if source is not None}


def format_count(count: int, word: str) -> str:
    """Return a count with its noun, such as `2 files`."""
    return f"{count} {word}{'s' * (count != 1)}"


def _read(path: str) -> Source | None:
    try:
        return decode(path, read_file(Path(path)))
    except (OSError, ValueError):
        return None
