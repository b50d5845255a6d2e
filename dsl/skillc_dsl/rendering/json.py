"""Diagnostics as a JSON list."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any

from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_dsl.rendering.printable import escaped
from skillc_dsl.source import Source, Span


def render(diagnostics: Iterable[Diagnostic], sources: Mapping[str, Source]) -> str:
    """Return a list of objects; lines and columns count from 1, the end column is exclusive."""
    return (
        escaped(json.dumps([_as_data(diagnostic) for diagnostic in diagnostics], indent=2, ensure_ascii=False)) + "\n"
    )


def read(text: str) -> tuple[Diagnostic, ...]:
    """Return the diagnostics that `render` wrote."""
    return tuple(_diagnostic(data) for data in json.loads(text))


def _as_data(diagnostic: Diagnostic) -> dict[str, object]:
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


def _place(span: Span) -> dict[str, object]:
    return {
        "path": span.path,
        "line": span.line,
        "column": span.column,
        "end_line": span.end_line,
        "end_column": span.end_column,
    }


def _diagnostic(data: Mapping[str, Any]) -> Diagnostic:
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
