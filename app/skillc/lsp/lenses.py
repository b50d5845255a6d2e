"""Handlers of requests for code lenses: commands above declarations, which the editor carries out."""

from __future__ import annotations

from functools import partial

from lsprotocol import types

from skillc.lsp.libraries import FileView
from skillc.lsp.positions import PositionConverter
from skillc.lsp.session import Session
from skillc.services.reporting.reporter import format_count
from skillc_compiler.ide.annotations.lenses import Lens, find_lenses


def show_lenses(session: Session, params: types.CodeLensParams) -> list[types.CodeLens]:
    """Return the lenses of a file, as far as the editor has said in its options that it knows their commands."""
    view = session.libraries.view(params.text_document.uri)
    _, names = session.libraries.names(session.file(params.text_document.uri))
    lines = PositionConverter(names.texts, session.encoding)
    found = [_convert(session, view, lines, each) for each in find_lenses(names, view.path)]
    return [each for each in found if each.command is not None and each.command.command in session.commands]


def _convert(session: Session, view: FileView, lines: PositionConverter, lens: Lens) -> types.CodeLens:
    place, uri_of = lines.range(lens.span), partial(session.libraries.uri, view.root)
    if lens.kind == "references":
        locations = [types.Location(uri_of(each.path), lines.range(each)) for each in lens.places]
        title, shown = format_count(len(lens.places), "reference"), [uri_of(view.path), place.start, locations]
        return types.CodeLens(place, types.Command(title, "skillc.showReferences", arguments=shown))
    named = lens.name if lens.kind == "test" else f"{view.root.folder}:{lens.name}"
    what = {"arguments": [lens.kind, named], "folder": str(view.root.folder), "parameters": list(lens.parameters)}
    return types.CodeLens(place, types.Command(lens.kind, f"skillc.{lens.kind}", arguments=[what]))
