"""Diagnostics as a JSON list."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.rendering.printable import escaped
from skillc_dsl.source import Source, Span


def render(diagnostics: Iterable[Diagnostic], sources: Mapping[str, Source]) -> str:
    """Return a list of objects; lines and columns count from 1, the end column is exclusive."""
    return escaped(json.dumps([as_data(diagnostic) for diagnostic in diagnostics], indent=2, ensure_ascii=False)) + "\n"


def as_data(diagnostic: Diagnostic) -> dict[str, object]:
    """Return the fields of one diagnostic that machines read; `fix` is null where there is none."""
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
