"""Handlers of requests that edit: completion, renaming, fixes, formatting."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

from lsprotocol import types
from pygls.exceptions import JsonRpcInvalidParams

from skillc.lsp import diagnostics as problems
from skillc.lsp.files import Root, is_rdf
from skillc.lsp.libraries import FileView
from skillc.lsp.positions import PositionConverter
from skillc.lsp.scenes import read_scene_texts
from skillc.lsp.session import Session
from skillc.services.project.backends import list_backends
from skillc_compiler.ide.completion import complete
from skillc_compiler.ide.creations import find_creations
from skillc_compiler.ide.imports import make_import, make_use
from skillc_compiler.ide.missing_individuals import UNKNOWN, find_missing_individuals
from skillc_compiler.ide.offers import Offer
from skillc_compiler.ide.rename import NotRenamable, find_renamable
from skillc_compiler.ide.rename import rename as renamed
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.edits import drop_overlapping
from skillc_dsl.source import Source, Span
from skillc_ontology import catalogue

FIX_ALL = "source.fixAll.skillc"
_KINDS = {
    "keyword": types.CompletionItemKind.Keyword,
    "class": types.CompletionItemKind.Class,
    "type": types.CompletionItemKind.Struct,
    "relation": types.CompletionItemKind.Method,
    "property": types.CompletionItemKind.Property,
    "function": types.CompletionItemKind.Function,
    "skill": types.CompletionItemKind.Interface,
    "implementation": types.CompletionItemKind.Reference,
    "parameter": types.CompletionItemKind.Field,
    "variable": types.CompletionItemKind.Variable,
    "label": types.CompletionItemKind.Event,
    "individual": types.CompletionItemKind.Constant,
    "value": types.CompletionItemKind.EnumMember,
    "unit": types.CompletionItemKind.Unit,
    "vocabulary": types.CompletionItemKind.Module,
    "file": types.CompletionItemKind.File,
    "diagnostic": types.CompletionItemKind.Text,
}


def offer_completions(session: Session, params: types.CompletionParams) -> types.CompletionList:
    """Offer what fits at the cursor."""
    at = session.at(params)
    warnings = sorted({problem.name for problem in at.view.analysis.problems if problem.severity == "warning"})
    scenes = [*sorted(_scenes_beside(at.view)), *catalogue.scene_names()]
    found = complete(at.view.analysis, at.view.path, at.line, at.column, scenes, warnings, list_backends())
    place = at.lines.range(found.replaced)
    items = [_item(offer, order, place) for order, offer in enumerate(found.offers)]
    for item, offer in zip(items, found.offers, strict=True):
        make, what = (make_import, offer.imports) if offer.imports else (make_use, offer.uses)
        if what:
            line = make(at.view.analysis, at.view.path, what)
            item.additional_text_edits = [types.TextEdit(at.lines.range(line.span), line.text)]
    return types.CompletionList(False, items)


def prepare_rename(session: Session, params: types.PrepareRenameParams) -> types.PrepareRenamePlaceholder:
    """Return the range of the name to be renamed; an error if it cannot be renamed."""
    at = session.at_name(params)
    match find_renamable(at.names, *at.place):
        case NotRenamable(reason=reason):
            raise JsonRpcInvalidParams(reason)
        case span:
            line = at.names.texts[span.path].split("\n")[span.line - 1]
            return types.PrepareRenamePlaceholder(at.lines.range(span), line[span.column - 1 : span.end_column - 1])


def rename(session: Session, params: types.RenameParams) -> types.WorkspaceEdit:
    """Return the edits that rename the symbol; an error if it cannot be renamed."""
    at, libraries = session.at_name(params), session.libraries
    judge = partial(libraries.after, at.root)
    match renamed(at.names, *at.place, params.new_name, libraries.problems(at.root), judge):
        case NotRenamable(reason=reason):
            raise JsonRpcInvalidParams(reason)
        case renaming:
            return _workspace_edit(session, at.root, at.lines, renaming.edits)


def offer_code_actions(session: Session, params: types.CodeActionParams) -> list[types.CodeAction]:
    """Offer the fixes of the diagnostics in a range, and one action for all safe fixes of the file."""
    if is_rdf(session.file(params.text_document.uri)):
        return _in_turtle(session, params)
    view = session.libraries.view(params.text_document.uri)
    here = [problem for problem in view.analysis.problems if problem.span.path == view.path]
    touched = _touched(params, session.lines(view), here)
    tried = view.analysis.with_useful_fixes([each for each in here if each in touched or (each.fix and each.fix.safe)])
    lines = session.lines(view)
    found = _actions(session, params, view.root, lines, tried)
    if not _wanted(params, types.CodeActionKind.QuickFix.value):
        return found
    made = find_creations(view.analysis, touched)
    cured = [replace(each.problem, fix=each.edit) for each in made]
    stated = _individuals(session, params, touched)
    return [*found, *(_quick_fix(session, view.root, lines, each) for each in cured), *stated]


def _individuals(
    session: Session, params: types.CodeActionParams, touched: Sequence[Diagnostic]
) -> Iterator[types.CodeAction]:
    """Yield the fixes that state an individual in the scene of a task."""
    if not any(each.name == UNKNOWN for each in touched):
        return
    root, names = session.libraries.names(session.file(params.text_document.uri))
    lines = PositionConverter(names.texts, session.encoding)
    for each in find_missing_individuals(names, touched, partial(session.libraries.after, root)):
        yield _quick_fix(session, root, lines, replace(each.problem, fix=each.edit))


def _in_turtle(session: Session, params: types.CodeActionParams) -> list[types.CodeAction]:
    """Offer the fixes of a scene or vocabulary, as the first library with diagnostics in it reports them."""
    libraries, file = session.libraries, session.file(params.text_document.uri)
    for root, analysis in libraries.known():
        around = libraries.problems_around(root)
        here = [problem for problem in around if libraries.find_file(root, problem.span.path) == file]
        if here:
            lines = PositionConverter(
                {**analysis.texts, **read_scene_texts(around, libraries.buffers)}, session.encoding
            )
            return _actions(session, params, root, lines, here)
    return []


def _actions(
    session: Session, params: types.CodeActionParams, root: Root, lines: PositionConverter, here: Sequence[Diagnostic]
) -> list[types.CodeAction]:
    actions = []
    if _wanted(params, types.CodeActionKind.QuickFix.value):
        touched = _touched(params, lines, here)
        actions += [_quick_fix(session, root, lines, problem) for problem in touched if problem.fix]
    safe = drop_overlapping(problem.fix for problem in here if problem.fix and problem.fix.safe)
    if safe and _wanted(params, FIX_ALL):
        edit = _workspace_edit(session, root, lines, safe)
        actions.append(types.CodeAction("Apply all safe fixes", FIX_ALL, edit=edit))
    return actions


def _touched(params: types.CodeActionParams, lines: PositionConverter, here: Sequence[Diagnostic]) -> list[Diagnostic]:
    return [problem for problem in here if _meet(lines.range(problem.span), params.range)]


def format_document(session: Session, params: types.DocumentFormattingParams) -> list[types.TextEdit]:
    """Return the edit that formats the file; none if it has errors or is already formatted."""
    from skillc_dsl.formatting.formatter import format_source

    view = session.libraries.view(params.text_document.uri)
    source = view.analysis.library.sources.get(view.path, Source(view.path, ""))
    outcome = format_source(source)
    if not outcome.ok or outcome.value == source.text:
        return []
    rows = source.text.split("\n")
    whole = Span(view.path, 1, 1, len(rows), len(rows[-1]) + 1)
    return [types.TextEdit(session.lines(view).range(whole), outcome.value)]


def _item(offer: Offer, order: int, place: types.Range) -> types.CompletionItem:
    text = types.MarkupContent(types.MarkupKind.Markdown, offer.documentation) if offer.documentation else None
    return types.CompletionItem(
        label=offer.text,
        kind=_KINDS[offer.kind],
        detail=offer.detail or None,
        documentation=text,
        sort_text=f"{order:04}",
        filter_text=offer.inserted,
        text_edit=types.TextEdit(place, offer.inserted),
    )


def _scenes_beside(view: FileView) -> Iterable[str]:
    folder = (view.root.folder / view.path).parent
    files = (
        file
        for pattern in ("*", "*/*")
        for file in folder.glob(pattern)
        if file.suffix in catalogue.ENDINGS and file.suffix != ".xml"
    )
    return (file.relative_to(folder).as_posix() for file in files)


def _quick_fix(session: Session, root: Root, lines: PositionConverter, problem: Diagnostic) -> types.CodeAction:
    assert problem.fix is not None
    return types.CodeAction(
        title=problem.fix.message,
        kind=types.CodeActionKind.QuickFix,
        diagnostics=[problems.convert_diagnostic(session.libraries, root, lines, problem)],
        is_preferred=problem.fix.safe,
        edit=_workspace_edit(session, root, lines, (problem.fix,)),
    )


def _wanted(params: types.CodeActionParams, kind: str) -> bool:
    only = params.context.only
    return only is None or any(kind == each or kind.startswith(f"{each}.") for each in only)


def _meet(one: types.Range, other: types.Range) -> bool:
    return one.start <= other.end and other.start <= one.end


def _workspace_edit(
    session: Session, root: Root, lines: PositionConverter, fixes: Iterable[Fix]
) -> types.WorkspaceEdit:
    changes: dict[str, list[types.TextEdit]] = defaultdict(list)
    for fix in fixes:
        uri = session.libraries.uri(root, fix.span.path)
        changes[uri].append(types.TextEdit(lines.range(fix.span), fix.text))
    edits: Mapping[str, list[types.TextEdit]] = dict(changes)
    return types.WorkspaceEdit(changes=edits)
