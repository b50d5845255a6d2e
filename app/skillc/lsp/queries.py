"""Handlers of requests that change nothing: hover, navigation, symbols, semantic tokens, folding, signatures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from lsprotocol import types

from skillc.lsp.files import Root
from skillc.lsp.positions import PositionConverter, count_units
from skillc.lsp.session import AtName, Session
from skillc_compiler.ide import highlighting, outline, places, project_names
from skillc_compiler.ide.calls import find_signature
from skillc_compiler.ide.descriptions import find_hover
from skillc_compiler.ide.outline import OutlineEntry
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
    "test": types.SymbolKind.Event,
    "parameter": types.SymbolKind.Variable,
    "condition": types.SymbolKind.Boolean,
    "let": types.SymbolKind.Constant,
}


def show_hover(session: Session, params: types.HoverParams) -> types.Hover | None:
    """Describe the name under the cursor."""
    at = session.at(params)
    found = find_hover(at.view.analysis, at.view.path, at.line, at.column)
    if found is None:
        return None
    content = types.MarkupContent(types.MarkupKind.Markdown, found.markdown)
    return types.Hover(content, at.lines.range(found.span))


def find_definition(session: Session, params: types.DefinitionParams) -> list[types.Location]:
    """Return where the name under the cursor is declared; an individual where a scene states its class."""
    at = session.at_name(params)
    return _locations(session, at, project_names.find_definitions(at.names, *at.place))


def find_implementations(session: Session, params: types.ImplementationParams) -> list[types.Location]:
    """Return the implementations of the skill under the cursor."""
    at = session.at_name(params)
    skills = [o.symbol.name for o in at.names.at(*at.place) if isinstance(o.symbol, SkillSymbol)]
    ways = [way for name in skills for way in at.names.analysis.program.implementations_of.get(name, ())]
    symbols = [ImplementationSymbol(way.skill.name, way.name) for way in ways]
    found = (span for symbol in symbols for span in places.find_declarations(at.names.analysis, symbol))
    return _locations(session, at, found)


def find_references(session: Session, params: types.ReferenceParams) -> list[types.Location]:
    """Return the references to the symbol under the cursor, in skills, scenes, vocabularies and the manifest."""
    at, wanted = session.at_name(params), params.context.include_declaration
    return _locations(session, at, project_names.find_references(at.names, *at.place, declarations=wanted))


def find_highlights(session: Session, params: types.DocumentHighlightParams) -> list[types.DocumentHighlight]:
    """Return the references in this file to the symbol under the cursor."""
    at = session.at(params)
    found = places.find_references(at.view.analysis, at.view.path, at.line, at.column, declarations=True)
    return [types.DocumentHighlight(at.lines.range(span)) for span in found if span.path == at.view.path]


def list_document_symbols(session: Session, params: types.DocumentSymbolParams) -> list[types.DocumentSymbol]:
    """Return the declarations of a file as a tree."""
    view = session.libraries.view(params.text_document.uri)
    lines = session.lines(view)
    file = next((unit.file for unit in view.analysis.program.files if unit.file.path == view.path), None)
    return [_symbol(lines, entry) for entry in outline.make_outline(file)] if file else []


def list_workspace_symbols(session: Session, params: types.WorkspaceSymbolParams) -> list[types.WorkspaceSymbol]:
    """Return the declarations in all open libraries whose names contain the query's letters in order."""
    query = params.query.lower()
    return [symbol for symbol in _declared(session) if _holds(symbol.name.lower(), query)]


def encode_semantic_tokens(session: Session, params: types.SemanticTokensParams) -> types.SemanticTokens:
    """Return the semantic tokens of a file, in the protocol's relative encoding."""
    view = session.libraries.view(params.text_document.uri)
    lines = view.analysis.texts.get(view.path, "").split("\n")
    data: list[int] = []
    row, start = 0, 0
    for word in highlighting.highlight_words(view.analysis, view.path):
        text = lines[word.span.line - 1]
        at = count_units(text[: word.span.column - 1], session.encoding)
        width = count_units(text[word.span.column - 1 : word.span.end_column - 1], session.encoding)
        down = word.span.line - 1 - row
        data += (down, at if down else at - start, width, TOKEN_KINDS.index(word.kind), DECLARATION * word.declares)
        row, start = word.span.line - 1, at
    return types.SemanticTokens(data)


def find_folds(session: Session, params: types.FoldingRangeParams) -> list[types.FoldingRange]:
    """Return the ranges of lines that can be folded."""
    view = session.libraries.view(params.text_document.uri)
    file = next((unit.file for unit in view.analysis.program.files if unit.file.path == view.path), None)
    source = view.analysis.library.sources.get(view.path, Source(view.path, ""))
    found = outline.find_folds(source, file) if file else ()
    return [types.FoldingRange(fold.first - 1, fold.last - 1, kind=types.FoldingRangeKind(fold.kind)) for fold in found]


def show_signature(session: Session, params: types.SignatureHelpParams) -> types.SignatureHelp | None:
    """Return the parameters of the call around the cursor."""
    at = session.at(params)
    found = find_signature(at.view.analysis, at.view.path, at.line, at.column)
    if found is None:
        return None
    parameters = [types.ParameterInformation(label, doc or None) for label, doc in found.parameters]
    text = types.MarkupContent(types.MarkupKind.Markdown, found.documentation)
    information = types.SignatureInformation(found.head, text, parameters, found.active)
    return types.SignatureHelp([information], 0, found.active)


def _locations(session: Session, at: AtName, spans: Iterable[Span]) -> list[types.Location]:
    return [types.Location(session.libraries.uri(at.root, span.path), at.lines.range(span)) for span in spans]


def _symbol(lines: PositionConverter, entry: OutlineEntry) -> types.DocumentSymbol:
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
        lines = PositionConverter(analysis.texts, session.encoding)
        for unit in analysis.program.files:
            for entry in outline.make_outline(unit.file):
                yield _workspace_symbol(session, root, lines, entry)


def _workspace_symbol(
    session: Session, root: Root, lines: PositionConverter, entry: OutlineEntry
) -> types.WorkspaceSymbol:
    location = types.Location(session.libraries.uri(root, entry.span.path), lines.range(entry.name_span))
    return types.WorkspaceSymbol(location, entry.name, _SYMBOL_KINDS[entry.kind], container_name=entry.detail or None)


def _holds(name: str, query: str) -> bool:
    letters = iter(name)
    return all(letter in letters for letter in query)
