"""Requests that only look: hover, places, outlines, colours, folds, signatures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from lsprotocol import types

from skillc.lsp.files import Root
from skillc.lsp.positions import Lines, units
from skillc.lsp.session import At, Session
from skillc_compiler.ide import highlighting, outline, places
from skillc_compiler.ide.calls import signature
from skillc_compiler.ide.hover import hover
from skillc_compiler.ide.outline import Entry
from skillc_compiler.ide.symbols import ImplementationSymbol, SkillSymbol
from skillc_dsl.source import Source, Span

TOKEN_KINDS = (
    *("namespace", "class", "type", "method", "property", "function", "interface", "parameter", "variable"),
    *("enumMember", "decorator", "keyword", "comment", "string", "number", "operator"),
)
DECLARATION = 1
_SYMBOL_KINDS = {
    "class": types.SymbolKind.Class,
    "relation": types.SymbolKind.Method,
    "property": types.SymbolKind.Property,
    "function": types.SymbolKind.Function,
    "skill": types.SymbolKind.Interface,
    "implementation": types.SymbolKind.Object,
    "task": types.SymbolKind.Event,
    "parameter": types.SymbolKind.Variable,
    "condition": types.SymbolKind.Boolean,
    "let": types.SymbolKind.Constant,
}


def hovered(session: Session, params: types.HoverParams) -> types.Hover | None:
    """Tell what the name under the cursor is."""
    at = session.at(params)
    found = hover(at.view.analysis, at.view.path, at.line, at.column)
    if found is None:
        return None
    content = types.MarkupContent(types.MarkupKind.Markdown, found.markdown)
    return types.Hover(content, at.lines.range(found.span))


def definition(session: Session, params: types.DefinitionParams) -> list[types.Location]:
    """Tell where the name under the cursor is declared."""
    at = session.at(params)
    return _locations(session, at, places.definition(at.view.analysis, at.view.path, at.line, at.column))


def implementation(session: Session, params: types.ImplementationParams) -> list[types.Location]:
    """Tell where the skill under the cursor is implemented."""
    at = session.at(params)
    found = places.symbols_at(at.view.analysis, at.view.path, at.line, at.column)
    names = [o.symbol.name for o in found if isinstance(o.symbol, SkillSymbol)]
    ways = [way for name in names for way in at.view.analysis.program.implementations_of.get(name, ())]
    symbols = [ImplementationSymbol(way.skill.name, way.name) for way in ways]
    return _locations(session, at, (s for symbol in symbols for s in places.declared(at.view.analysis, symbol)))


def references(session: Session, params: types.ReferenceParams) -> list[types.Location]:
    """Tell where the thing under the cursor is named."""
    at = session.at(params)
    wanted = params.context.include_declaration
    return _locations(
        session, at, places.references(at.view.analysis, at.view.path, at.line, at.column, declarations=wanted)
    )


def highlights(session: Session, params: types.DocumentHighlightParams) -> list[types.DocumentHighlight]:
    """Tell where the thing under the cursor is named in this file."""
    at = session.at(params)
    found = places.references(at.view.analysis, at.view.path, at.line, at.column, declarations=True)
    return [types.DocumentHighlight(at.lines.range(span)) for span in found if span.path == at.view.path]


def document_symbols(session: Session, params: types.DocumentSymbolParams) -> list[types.DocumentSymbol]:
    """Tell what the file declares."""
    view = session.libraries.view(params.text_document.uri)
    lines = session.lines(view)
    file = next((unit.file for unit in view.analysis.program.files if unit.file.path == view.path), None)
    return [_symbol(lines, entry) for entry in outline.outline(file)] if file else []


def workspace_symbols(session: Session, params: types.WorkspaceSymbolParams) -> list[types.WorkspaceSymbol]:
    """Tell what the libraries at hand declare whose name holds the letters that are asked for, in their order."""
    query = params.query.lower()
    return [symbol for symbol in _declared(session) if _holds(symbol.name.lower(), query)]


def colours(session: Session, params: types.SemanticTokensParams) -> types.SemanticTokens:
    """Tell what each word is, each as its distance from the one before."""
    view = session.libraries.view(params.text_document.uri)
    lines = view.analysis.texts.get(view.path, "").split("\n")
    data: list[int] = []
    row, start = 0, 0
    for word in highlighting.highlighted(view.analysis, view.path):
        text = lines[word.span.line - 1]
        at = units(text[: word.span.column - 1], session.encoding)
        width = units(text[word.span.column - 1 : word.span.end_column - 1], session.encoding)
        down = word.span.line - 1 - row
        data += (down, at if down else at - start, width, TOKEN_KINDS.index(word.kind), DECLARATION * word.declares)
        row, start = word.span.line - 1, at
    return types.SemanticTokens(data)


def folding(session: Session, params: types.FoldingRangeParams) -> list[types.FoldingRange]:
    """Tell which lines belong together."""
    view = session.libraries.view(params.text_document.uri)
    file = next((unit.file for unit in view.analysis.program.files if unit.file.path == view.path), None)
    source = Source(view.path, view.analysis.texts.get(view.path, ""))
    found = outline.folds(source, file) if file else ()
    return [types.FoldingRange(fold.first - 1, fold.last - 1, kind=types.FoldingRangeKind(fold.kind)) for fold in found]


def signature_help(session: Session, params: types.SignatureHelpParams) -> types.SignatureHelp | None:
    """Tell what the call around the cursor takes."""
    at = session.at(params)
    found = signature(at.view.analysis, at.view.path, at.line, at.column)
    if found is None:
        return None
    parameters = [types.ParameterInformation(label, doc or None) for label, doc in found.parameters]
    text = types.MarkupContent(types.MarkupKind.Markdown, found.documentation)
    information = types.SignatureInformation(found.head, text, parameters, found.active)
    return types.SignatureHelp([information], 0, found.active)


def _locations(session: Session, at: At, spans: Iterable[Span]) -> list[types.Location]:
    return [types.Location(session.libraries.uri(at.view.root, span.path), at.lines.range(span)) for span in spans]


def _symbol(lines: Lines, entry: Entry) -> types.DocumentSymbol:
    return types.DocumentSymbol(
        name=entry.name,
        detail=entry.detail or None,
        kind=_SYMBOL_KINDS[entry.kind],
        range=lines.range(entry.span),
        selection_range=lines.range(entry.name_span),
        children=[_symbol(lines, child) for child in entry.children],
    )


def _declared(session: Session) -> Iterator[types.WorkspaceSymbol]:
    for root, analysis in session.libraries.known():
        lines = Lines(analysis.texts, session.encoding)
        for unit in analysis.program.files:
            for entry in outline.outline(unit.file):
                yield _workspace_symbol(session, root, lines, entry)


def _workspace_symbol(session: Session, root: Root, lines: Lines, entry: Entry) -> types.WorkspaceSymbol:
    location = types.Location(session.libraries.uri(root, entry.span.path), lines.range(entry.name_span))
    return types.WorkspaceSymbol(location, entry.name, _SYMBOL_KINDS[entry.kind], container_name=entry.detail or None)


def _holds(name: str, query: str) -> bool:
    letters = iter(name)
    return all(letter in letters for letter in query)
