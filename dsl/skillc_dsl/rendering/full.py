"""Diagnostics with the text they speak of: line numbers, carets, causes and cures."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.rendering.printable import printable
from skillc_dsl.source import Source, Span

_COLOURS = {"error": "31", "warning": "33", "place": "36", "label": "34", "help": "32"}
_LONGEST = 160


@dataclass(frozen=True, slots=True)
class _Paint:
    """Puts text in a colour of the terminal, or leaves it plain."""

    on: bool

    def __call__(self, kind: str, text: str) -> str:
        return f"\x1b[1;{_COLOURS[kind]}m{text}\x1b[0m" if self.on and text else text


def render(diagnostics: Iterable[Diagnostic], sources: Mapping[str, Source], *, colour: bool = False) -> str:
    """Return each diagnostic with the lines it speaks of; places whose source is not among `sources` are only named."""
    paint = _Paint(colour)
    return "\n".join("\n".join(_lines(diagnostic, sources, paint)) + "\n" for diagnostic in diagnostics)


def _lines(diagnostic: Diagnostic, sources: Mapping[str, Source], paint: _Paint) -> list[str]:
    """Return the lines of one diagnostic; a line of its file that is too long for a page is shown around the place."""
    severity = diagnostic.severity
    marks = [(diagnostic.span, "", severity), *((label.span, label.message, "label") for label in diagnostic.labels)]
    width = max(len(str(span.line)) for span, _, _ in marks)
    lines = [f"{paint(severity, f'{severity}[{diagnostic.name}]')}: {printable(diagnostic.message)}"]
    for span, message, kind in marks:
        lines += _excerpt(span, message, kind, width, sources, paint)
    if diagnostic.help:
        lines.append(f"{' ' * width} {paint('help', 'help')}: {printable(diagnostic.help)}")
    if diagnostic.fix:
        lines.append(f"{' ' * width} {paint('help', 'fix')}: {printable(diagnostic.fix.message)}")
    return lines


def _excerpt(
    span: Span, message: str, kind: str, width: int, sources: Mapping[str, Source], paint: _Paint
) -> list[str]:
    """Return the first line of `span` under its place, with carets below and `message` beside them."""
    margin = " " * width
    place = f"{margin}{paint('place', '-->')} {printable(span.path)}:{span.line}:{span.column}"
    source = sources.get(span.path)
    text = source.text.split("\n") if source else []
    if span.line > len(text):
        return [f"{place}: {printable(message)}" if message else place]
    whole = printable(text[span.line - 1].rstrip("\r"))
    end = span.end_column if span.end_line == span.line else len(whole) + 1
    left = 0 if len(whole) <= _LONGEST else max(0, span.column - 1 - _LONGEST // 2)
    line = whole[left : left + _LONGEST]
    indent = "".join("\t" if character == "\t" else " " for character in line[: span.column - 1 - left])
    carets = "^" * max(1, min(end, left + len(line) + 1) - span.column)
    marked = paint(kind, carets + (f" {printable(message)}" if message else ""))
    return [
        place,
        f"{margin} {paint('place', '|')}",
        f"{span.line:>{width}} {paint('place', '|')} {line}",
        f"{margin} {paint('place', '|')} {indent}{marked}",
    ]
