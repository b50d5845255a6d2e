"""Checks a library again after edits of bodies: only the files that these concern, with the result of a whole check."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from skillc.services.library_files import LibraryFiles
from skillc.services.reporting import sort_diagnostics
from skillc.services.snapshots import Snapshot, update_snapshot
from skillc.services.value_checks import files_with_texts
from skillc.services.vocabulary_cache import load_vocabulary_once
from skillc_compiler.checks import load_checks
from skillc_compiler.checks.planning import UNPLANNABLE
from skillc_compiler.problems import find_problems, visible_diagnostics
from skillc_compiler.program.outlines import TASK, FileOutline, outline_of
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.slices import Dependencies, changed_skills
from skillc_compiler.program.typed import ParsedFile
from skillc_compiler.resolve.files import Parser, read_sources
from skillc_compiler.resolve.program import resolve_program
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.garbage import gc_disabled
from skillc_dsl.source import Source


def check_edits(library: LibraryFiles, before: Snapshot, parse: Parser) -> Snapshot | None:
    """Return the snapshot of a library, given the last one; None if it has to be checked as a whole.

    That is so if more than the bodies of implementations has changed, if there is an error, or if an edit concerns a
    task or a text that may name something in a scene.
    """
    edited = before.edited(library.sources)
    now = _outlines(edited, before, parse)
    if now is None:
        return None
    outlines = {**before.outlines, **now}
    dependencies = Dependencies(outlines)
    skills = dependencies.callers(changed_skills(before.outlines, now))
    checked = dependencies.concerned(skills) | edited.keys()
    if TASK in skills or not checked.isdisjoint(before.texts):
        return None
    own = {source.path: source for source in library.sources}
    needed = dependencies.needed(checked)
    if any(outlines[path].has_tasks or path not in own or "allow" in own[path].text for path in checked):
        return None
    with gc_disabled():
        found = _check_files(library, [own[path] for path in sorted(needed & own.keys())], checked, needed, parse)
    if found is None:
        return None
    shown = {library.display_path(path) for path in checked}
    kept = (each for each in before.diagnostics if each.span.path not in shown or each.name in _names_kept())
    return update_snapshot(before, edited, now, sort_diagnostics((*kept, *found)))


def _outlines(edited: Mapping[str, Source], before: Snapshot, parse: Parser) -> dict[str, FileOutline] | None:
    """Return the outlines of edited files, None if one has errors or shows other files something else."""
    found = {}
    for path, source in edited.items():
        parsed = parse(source)
        if parsed.diagnostics or parsed.value.errors:
            return None
        known = before.outlines[path]
        unit = ParsedFile(parsed.value, "", "", source.text)
        found[path] = msgspec.structs.replace(outline_of(unit), imports=known.imports)
        if found[path].shown != known.shown:
            return None
    return found


def _check_files(
    library: LibraryFiles, sources: list[Source], checked: frozenset[str], needed: frozenset[str], parse: Parser
) -> tuple[Diagnostic, ...] | None:
    """Return what is found in the files `checked`; None if there is an error, or if needed files are not imported."""
    vocabulary = load_vocabulary_once(library.vocabularies)
    files = read_sources(sources, library.importable, library.name, parse, library.namespaces)
    program = resolve_program(files.value, vocabulary, library.name, {})
    if not needed <= {unit.file.path for unit in files.value}:
        return None
    if not checked.isdisjoint(files_with_texts(program.value)):
        return None
    problems = find_problems(files, program, paths=checked)
    if any(problem.severity == "error" for problem in problems):
        return None
    here = [problem for problem in problems if problem.span.path in checked]
    return tuple(library.with_display_paths(each) for each in visible_diagnostics(here, sources))


def _names_kept() -> frozenset[str]:
    """Return the diagnostics that do not depend on bodies."""
    return frozenset({UNPLANNABLE}).union(*(one.NAMES for one in load_checks() if one.READS is Reads.LIBRARY))
