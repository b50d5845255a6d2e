"""One line for each diagnostic, as editors and terminals expect it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.rendering.printable import printable
from skillc_dsl.source import Source


def render(diagnostics: Iterable[Diagnostic], sources: Mapping[str, Source]) -> str:
    """Return `path:line:column: severity[name]: message` lines."""
    return "".join(f"{_line(diagnostic)}\n" for diagnostic in diagnostics)


def _line(diagnostic: Diagnostic) -> str:
    span = diagnostic.span
    place = f"{span.path}:{span.line}:{span.column}"
    return printable(f"{place}: {diagnostic.severity}[{diagnostic.name}]: {diagnostic.message}")
