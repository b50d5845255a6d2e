"""Moves a project to the newest edition of the language: its skill files, and `edition` in its manifest."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import msgspec

from skillc.errors import RequestError
from skillc.services.check.fixing import FileChange
from skillc.services.check.library_checks import check_library
from skillc.services.library.files import LibraryFiles, find_library
from skillc.services.library.libraries import load_vocabulary_with
from skillc.services.project.goal_texts import read_goals
from skillc.services.project.loading import find_project
from skillc.services.project.manifest import read_manifest
from skillc.services.project.project import MANIFEST, Project
from skillc.services.project.toml_places import TomlPlaces
from skillc_compiler.ide.analysis import Analysis, AnalysisInput, analyse
from skillc_compiler.ide.edition_edits import find_edition_edits
from skillc_compiler.ide.project_names import NamedGoal
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.editions import NEWEST
from skillc_dsl.edits import apply_fixes
from skillc_dsl.formatting.formatter import format_source
from skillc_dsl.source import Source, Span


class EditionMove(msgspec.Struct, frozen=True):
    """The edition of a project before, the edits of its skill files with displayable paths, and the files that change.

    `problems` are errors because of which nothing may be changed, in the edition `failed`: its own, or the newest one.
    """

    before: int
    edits: tuple[Fix, ...] = ()
    changes: tuple[FileChange, ...] = ()
    problems: tuple[Diagnostic, ...] = ()
    failed: int = NEWEST
    texts: dict[str, Source] = {}


def find_edition_move(path: Path) -> EditionMove:
    """Return what moves the project at a path to the newest edition; nothing is written.

    One that has errors in its own edition, and none in the newest one, is moved as it is.
    RequestError for a path in no project.
    """
    project = find_project(path)
    if project is None:
        write = f"write one with `name` and `edition = {NEWEST}`"
        raise RequestError(f"{path.resolve()} is in no project: there is no {MANIFEST}; {write}")
    library, edition = find_library(project.root), project.manifest.edition
    if edition == NEWEST:
        return EditionMove(edition)
    wrong = _errors(library)
    edits = () if wrong else _edits(library)
    moved = library._replace(
        sources=tuple(_move(each, edits) for each in library.sources), project=_move_manifest(project, edits)
    )
    if then := _errors(moved):
        in_own = EditionMove(edition, problems=wrong, failed=edition, texts=_texts(library))
        return in_own if wrong else EditionMove(edition, problems=then, texts=_texts(moved))
    shown = (each._replace(span=each.span._replace(path=library.display_path(each.span.path))) for each in edits)
    return EditionMove(edition, tuple(shown), tuple(_changes(library, moved)))


def _errors(library: LibraryFiles) -> tuple[Diagnostic, ...]:
    return tuple(each for each in check_library(library, None) if each.severity == "error")


def _edits(library: LibraryFiles) -> tuple[Fix, ...]:
    """Return the edits of the skill files, and of the goals and calls in the manifest.

    Each of these is read as a task of a file that sees all that the skill files see.
    """
    vocabulary = load_vocabulary_with(library.vocabularies).value
    sources = {each.path: each for each in library.sources}
    read = AnalysisInput(library.name, sources, library.importable, vocabulary, namespaces=library.namespaces)
    found = analyse(read)
    goals = {each.path: (each, goal) for each, goal in _read_goals(library, found)}
    if not goals:
        return find_edition_edits(found)
    beside = {path: source for path, (source, _) in goals.items()}
    return tuple(
        placed
        for each in find_edition_edits(analyse(replace(read, sources={**sources, **beside})))
        if (placed := _place(each, *goals[each.span.path]) if each.span.path in goals else each) is not None
    )


def _read_goals(library: LibraryFiles, found: Analysis) -> Iterator[tuple[Source, NamedGoal]]:
    """Yield each goal and call of the manifest with a skill file in which its text begins a line."""
    own = [unit for unit in found.program.files if unit.file.path in found.library.sources]
    header = [line for unit in own for line in unit.file.header]
    used = sorted({name.text for line in header if isinstance(line, s.Use) for name in line.vocabularies})
    others = {line.path.value for unit in own for line, path in unit.imports if path not in found.library.sources}
    imports = sorted({unit.file.path for unit in own} | others)
    prefixes = {line.name.text: line.iri for line in header if isinstance(line, s.Prefix)}
    lines = [f"use {', '.join(used)}"] if used else []
    lines += [*(f'import "{each}"' for each in imports), *(f"prefix {name}: <{iri}>" for name, iri in prefixes.items())]
    project = library.project
    for number, goal in enumerate(read_goals(project) if project is not None else ()):
        if isinstance(goal, NamedGoal):
            text = "\n".join((*lines, f"task own_goal_{number} {{", goal.kind, goal.text, "}\n"))
            yield Source(f"{MANIFEST}-{number}.skill", text, edition=library.sources[0].edition), goal


def _place(edit: Fix, source: Source, goal: NamedGoal) -> Fix | None:
    """Return an edit of the file of a goal as one of the manifest; None for one of the lines above it."""
    above = source.text.count("\n") - goal.text.count("\n") - 2
    row = edit.span.line - above
    if row < 1:
        return None
    column = goal.column - 1 if row == 1 else 0
    line = goal.line + row - 1
    span = Span(goal.path, line, edit.span.column + column, line, edit.span.end_column + column)
    return edit._replace(span=span)


def _move(source: Source, edits: tuple[Fix, ...]) -> Source:
    """Return a file in the newest edition, formatted if it was so before."""
    own = [each for each in edits if each.span.path == source.path]
    moved = source._replace(text=apply_fixes(source.text, own), edition=NEWEST)
    was_formatted = own and format_source(source).value == source.text
    return moved._replace(text=format_source(moved).value) if was_formatted else moved


def _move_manifest(project: Project, edits: tuple[Fix, ...]) -> Project:
    """Return a project with the newest edition and other names in goals, also in the text of its manifest."""
    own = [each for each in edits if each.span.path == MANIFEST]
    project = project._replace(source=project.source._replace(text=apply_fixes(project.source.text, own)))
    lines, places = project.source.text.split("\n"), TomlPlaces(project.source)
    stated = places.find(("edition",))
    if lines[stated.line - 1].lstrip().startswith("edition"):
        lines[stated.line - 1] = re.sub(r"(edition\s*=\s*)\d+", rf"\g<1>{NEWEST}", lines[stated.line - 1])
    else:
        lines.insert(places.find(("name",)).line, f"edition = {NEWEST}")
    source = project.source._replace(text="\n".join(lines))
    manifest = read_manifest(source).value
    assert manifest is not None, "only names and the edition change"
    return project._replace(manifest=manifest, source=source)


def _changes(before: LibraryFiles, after: LibraryFiles) -> Iterator[FileChange]:
    assert before.project is not None and after.project is not None, "only projects are moved"
    for old, new in zip(before.sources, after.sources, strict=True):
        if old.text != new.text:
            yield FileChange(before.places[old.path], before.display_path(old.path), old.text, new.text)
    manifest = before.project.source
    yield FileChange(before.project.root / MANIFEST, manifest.path, manifest.text, after.project.source.text)


def _texts(library: LibraryFiles) -> dict[str, Source]:
    shown = (each._replace(path=library.display_path(each.path)) for each in library.sources)
    return {each.path: each for each in shown}
