"""Diagnostics as workflow commands, which GitHub Actions shows as annotations in a pull request."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.rendering.printable import printable
from skillc_dsl.source import Source


def render(diagnostics: Iterable[Diagnostic], sources: Mapping[str, Source]) -> str:
    """Return one `::error file=..,line=..::message` line per diagnostic, with columns if it is on a single line."""
    return "".join(f"{_command(diagnostic)}\n" for diagnostic in diagnostics)


def _command(diagnostic: Diagnostic) -> str:
    span = diagnostic.span
    properties = {"file": span.path, "line": str(span.line), "endLine": str(span.end_line)}
    if span.line == span.end_line:
        properties |= {"col": str(span.column), "endColumn": str(span.end_column)}
    properties["title"] = diagnostic.name
    written = ",".join(f"{key}={_escaped_property(value)}" for key, value in properties.items())
    message = "\n".join(filter(None, (diagnostic.message, diagnostic.help)))
    kind = "notice" if diagnostic.severity == "note" else diagnostic.severity
    return f"::{kind} {written}::{_escaped(message)}"


def _escaped(text: str) -> str:
    """Return text with `%` and line breaks escaped for a workflow command."""
    return printable(text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A"))


def _escaped_property(text: str) -> str:
    """Return text escaped for a property, which includes `:` and `,`."""
    return _escaped(text).replace(":", "%3A").replace(",", "%2C")
