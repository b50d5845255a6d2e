"""Diagnostics as a JSON list."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any, Literal, TypedDict

from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_dsl.rendering.printable import escaped
from skillc_dsl.source import Source, Span


class PlaceData(TypedDict):
    """A range of text in the file `path`."""

    path: str
    line: int
    column: int
    end_line: int
    end_column: int


class LabelData(PlaceData):
    """Another place that a diagnostic is about."""

    message: str


class FixData(PlaceData):
    """An edit that removes the problem: `text` replaces the range; one that is not `safe` may change a meaning."""

    text: str
    message: str
    safe: bool


class DiagnosticData(PlaceData):
    """A problem: its name, as `skillc explain` knows it, where it is, and what to do about it."""

    name: str
    severity: Literal["error", "warning", "note"]
    message: str
    help: str
    labels: list[LabelData]
    fix: FixData | None


def render(diagnostics: Iterable[Diagnostic], sources: Mapping[str, Source]) -> str:
    """Return a list of objects; lines and columns count from 1, the end column is exclusive."""
    return escaped(json.dumps([to_data(diagnostic) for diagnostic in diagnostics], indent=2, ensure_ascii=False)) + "\n"


def read(text: str) -> tuple[Diagnostic, ...]:
    """Return the diagnostics that `render` wrote."""
    return tuple(from_data(data) for data in json.loads(text))


def to_data(diagnostic: Diagnostic) -> DiagnosticData:
    """Return the JSON object of one diagnostic; `fix` is null if there is none."""
    fix = diagnostic.fix
    return {
        "name": diagnostic.name,
        "severity": diagnostic.severity,
        **_place(diagnostic.span),
        "message": diagnostic.message,
        "help": diagnostic.help,
        "labels": [{**_place(label.span), "message": label.message} for label in diagnostic.labels],
        "fix": {**_place(fix.span), "text": fix.text, "message": fix.message, "safe": fix.safe} if fix else None,
    }


def _place(span: Span) -> PlaceData:
    return {
        "path": span.path,
        "line": span.line,
        "column": span.column,
        "end_line": span.end_line,
        "end_column": span.end_column,
    }


def from_data(data: Mapping[str, Any] | DiagnosticData) -> Diagnostic:
    """Return the diagnostic that `to_data` made an object of."""
    fix = data["fix"]
    return Diagnostic(
        data["name"],
        _span(data),
        data["message"],
        data["help"],
        data["severity"],
        tuple(Label(_span(each), each["message"]) for each in data["labels"]),
        fix and Fix(_span(fix), fix["text"], fix["message"], fix["safe"]),
    )


def _span(data: Mapping[str, Any]) -> Span:
    return Span(data["path"], data["line"], data["column"], data["end_line"], data["end_column"])
