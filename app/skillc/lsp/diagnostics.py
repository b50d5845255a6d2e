"""Converts diagnostics to those of the protocol."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path

from lsprotocol import types
from pygls.uris import from_fs_path

from skillc.lsp import scenes
from skillc.lsp.files import Root
from skillc.lsp.libraries import Libraries
from skillc.lsp.positions import PositionConverter
from skillc.services.library.bodiless import list_backends, without_unasked
from skillc_compiler.ide.analysis import Analysis
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span

_SEVERITY = {
    "error": types.DiagnosticSeverity.Error,
    "warning": types.DiagnosticSeverity.Warning,
    "note": types.DiagnosticSeverity.Information,
}


def diagnostics_by_uri(
    libraries: Libraries, root: Root, analysis: Analysis, around: Sequence[Diagnostic], encoding: str
) -> dict[str, list[types.Diagnostic]]:
    """Return the diagnostics of each file of a library (perhaps none), and those `around` it, by URI."""
    found: dict[str, list[types.Diagnostic]] = defaultdict(list)
    for path in analysis.library.sources:
        found[libraries.uri(root, path)] = []
    lines = PositionConverter({**analysis.texts, **scenes.read_scene_texts(around, libraries.buffers)}, encoding)
    asked = without_unasked(analysis.problems, list_backends(analysis.program), libraries.is_symbolic(root))
    for problem in (*asked, *around):
        found[libraries.uri(root, problem.span.path)].append(convert_diagnostic(libraries, root, lines, problem))
    return dict(found)


def diagnostics_after_failure(
    libraries: Libraries, root: Root, message: str, encoding: str
) -> dict[str, list[types.Diagnostic]]:
    """Return the syntax errors of a library's files, and `message` of an internal error in the open ones, by URI."""
    texts, parse = libraries.texts(root), libraries.parser(root)
    lines = PositionConverter({path: source.text for path, source in texts.items()}, encoding)
    start = types.Range(types.Position(0, 0), types.Position(0, 1))
    failure = types.Diagnostic(start, message, types.DiagnosticSeverity.Error, "internal-error", source="skillc")
    found: dict[str, list[types.Diagnostic]] = {uri: [failure] for uri in libraries.open_in(root)}
    for path, source in texts.items():
        syntax = [convert_diagnostic(libraries, root, lines, problem) for problem in parse(source).diagnostics]
        found[libraries.uri(root, path)] = [*found.get(libraries.uri(root, path), []), *syntax]
    return found


def convert_diagnostic(
    libraries: Libraries, root: Root, lines: PositionConverter, problem: Diagnostic
) -> types.Diagnostic:
    """Return a diagnostic with its help and labels."""
    return types.Diagnostic(
        range=lines.range(problem.span),
        message=f"{problem.message}\nhelp: {problem.help}" if problem.help else problem.message,
        severity=_SEVERITY[problem.severity],
        code=problem.name,
        source="skillc",
        tags=_tags(problem.name),
        related_information=[
            types.DiagnosticRelatedInformation(_location(libraries, root, lines, label.span), label.message)
            for label in problem.labels
        ]
        or None,
    )


def _location(libraries: Libraries, root: Root, lines: PositionConverter, span: Span) -> types.Location:
    file = Path(span.path)
    uri = from_fs_path(span.path) if file.is_absolute() else None
    return types.Location(uri or libraries.uri(root, span.path), lines.range(span))


def _tags(name: str) -> list[types.DiagnosticTag] | None:
    if name.startswith(("unused", "unreachable")):
        return [types.DiagnosticTag.Unnecessary]
    return [types.DiagnosticTag.Deprecated] if name.startswith("deprecated") else None
