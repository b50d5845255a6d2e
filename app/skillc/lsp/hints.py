"""Handlers of requests for hints, which are shown in the lines of a text."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

from lsprotocol import types

from skillc.lsp.files import is_rdf
from skillc.lsp.libraries import FileView
from skillc.lsp.positions import PositionConverter
from skillc.lsp.scenes import read_text
from skillc.lsp.session import Session
from skillc_compiler.ide.annotations.hints import Hint, find_hints
from skillc_compiler.ide.annotations.units import find_units
from skillc_dsl.source import Span
from skillc_rdf.turtle.parser import parse

_KINDS = {"type": types.InlayHintKind.Type, "parameter": types.InlayHintKind.Parameter, "choice": None}
_parse = lru_cache(4)(parse)


def show_hints(session: Session, params: types.InlayHintParams) -> list[types.InlayHint]:
    """Return the hints in a range: types, inferred parameters, implementations chosen in a scene, units of numbers."""
    view = session.libraries.view(params.text_document.uri)
    rows = range(params.range.start.line + 1, params.range.end.line + 2)
    if is_rdf(file := session.file(params.text_document.uri)):
        text = read_text(file, session.libraries.buffers)
        statements = _parse(view.path, text, "file:///scene").statements if file.suffix == ".ttl" else ()
        found: Iterable[Hint] = find_units(statements, view.analysis.program.vocabulary, rows)
        return _convert(view, PositionConverter({view.path: text}, session.encoding), found)
    found = find_hints(view.analysis, view.path, rows, session.libraries.choices(view, rows))
    return _convert(view, session.lines(view), found)


def _convert(view: FileView, lines: PositionConverter, found: Iterable[Hint]) -> list[types.InlayHint]:
    return [
        types.InlayHint(
            lines.range(Span(view.path, each.line, each.column, each.line, each.column)).start,
            each.text,
            kind=_KINDS[each.kind],
            tooltip=types.MarkupContent(types.MarkupKind.Markdown, each.about),
        )
        for each in found
    ]
