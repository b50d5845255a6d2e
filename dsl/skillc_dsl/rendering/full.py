"""Diagnostics with excerpts of their sources: line numbers, carets, causes and fixes."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator, Mapping

from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.edits import apply_fixes
from skillc_dsl.rendering.columns import clip_line, lay_out
from skillc_dsl.rendering.excerpt import ExcerptLayout, Underline, render_excerpt
from skillc_dsl.rendering.paint import Paint
from skillc_dsl.rendering.printable import printable
from skillc_dsl.source import Source


def render(
    diagnostics: Iterable[Diagnostic], sources: Mapping[str, Source], *, colour: bool = False, width: int | None = None
) -> str:
    """Return each diagnostic with the lines that it refers to; a place without a source in `sources` has no excerpt.

    `width` is the width of the output in cells: messages are wrapped and long lines of source clipped around their
    marks. If it is None, nothing is wrapped.
    """
    paint = Paint(colour)
    return "\n".join("\n".join(_lines(each, sources, paint, width)) + "\n" for each in diagnostics)


def _lines(diagnostic: Diagnostic, sources: Mapping[str, Source], paint: Paint, width: int | None) -> Iterator[str]:
    severity = diagnostic.severity
    marks = [
        Underline(diagnostic.span, "", severity),
        *(Underline(each.span, each.message, "label") for each in diagnostic.labels),
    ]
    page = ExcerptLayout(paint, width, max(len(str(mark.span.line)) for mark in marks))
    first, *rest = _wrapped(f"{severity}[{diagnostic.name}]: {printable(diagnostic.message)}", width, "  ")
    head, colon, tail = first.partition(": ")
    yield f"{paint(severity, head)}{colon}{tail}"
    yield from rest
    for number, path in enumerate(dict.fromkeys(mark.span.path for mark in marks)):
        own = [mark for mark in marks if mark.span.path == path]
        yield from render_excerpt(sources.get(path), own, ":::" if number else "-->", page)
    said_by_fix = (diagnostic.fix.message,) if diagnostic.fix else ()
    if diagnostic.help and diagnostic.help not in said_by_fix:
        yield from _note("help", diagnostic.help, page)
    if diagnostic.fix:
        yield from _fix(diagnostic, diagnostic.fix, sources, page)


def _note(title: str, text: str, page: ExcerptLayout) -> Iterator[str]:
    """Yield a note below an excerpt, wrapped with a hanging indent."""
    margin = " " * (page.digits + 1)
    first, *rest = _wrapped(f"{margin}= {title}: {printable(text)}", page.width, f"{margin}{' ' * (len(title) + 4)}")
    begin = len(f"{margin}= ")
    yield f"{first[:begin]}{page.paint('help', first[begin : begin + len(title)])}{first[begin + len(title) :]}"
    yield from rest


def _fix(diagnostic: Diagnostic, fix: Fix, sources: Mapping[str, Source], page: ExcerptLayout) -> Iterator[str]:
    """Yield the title of a fix and the lines that it writes; no lines if it only replaces the marked word."""
    yield from _note("fix", f"{fix.message}{' (--fix does it)' if fix.safe else ''}", page)
    source = sources.get(fix.span.path)
    old = source.text.split("\n") if source else []
    if source is None or fix.span == diagnostic.span or fix.span.end_line > len(old):
        return
    new = apply_fixes(source.text, [fix]).split("\n")
    changed = new[fix.span.line - 1 : fix.span.line + fix.text.count("\n")]
    for line in (each for each in changed if each.strip() and each not in old):
        shown = clip_line(lay_out(line), 0, 1, page.room)
        yield f"{page.gutter('+')} {page.paint('help', shown.text)}"


def _wrapped(text: str, width: int | None, indent: str) -> list[str]:
    """Return text wrapped at `width` cells, with all lines after the first indented; words are never broken."""
    lines = text.split("\n")
    if width is None:
        return [lines[0], *(f"{indent}{line}" for line in lines[1:])]
    wrapped: list[str] = []
    for line in lines:
        first = indent if wrapped else ""
        wrapped += textwrap.wrap(
            line, width, initial_indent=first, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
        ) or [""]
    return wrapped
