"""Checks a library again after edits of skills and implementations: only the files that these concern.

The result is that of a whole check.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from typing import NamedTuple

import msgspec

from skillc.services.check.snapshots import Snapshot, digest_views, update_snapshot
from skillc.services.library.files import LibraryFiles
from skillc.services.reporting.reporter import sort_diagnostics
from skillc.services.tasks.value_checks import files_with_texts
from skillc_compiler.checks import load_checks
from skillc_compiler.checks.planning import UNPLANNABLE
from skillc_compiler.problems import find_problems, visible_diagnostics
from skillc_compiler.program.outlines import TASK, FileOutline, outline_of
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import ParsedFile, Program
from skillc_compiler.program.slices import Dependencies, changed_places, changed_signatures, changed_skills
from skillc_compiler.resolve.files import read_sources
from skillc_compiler.resolve.program import resolve_program
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.garbage import gc_disabled
from skillc_dsl.parsing.reparse import parse_with
from skillc_dsl.query import Memo
from skillc_dsl.source import Source
from skillc_rdf.vocabulary.types import Vocabulary

UNUSED_CONFLICT = "unused-conflict"
"""The warning about a conflict of ontologies that becomes an error when the library names its terms."""


def check_edits(library: LibraryFiles, before: Snapshot, memo: Memo) -> Snapshot | None:
    """Return the snapshot of a library, given the last one; None if it has to be checked as a whole.

    That is so if more than skills and implementations has changed, if there is an error, if an edit concerns a task, a
    text that may name something in a scene or a body that was looked at in space, or if it changes what the whole
    library reads of a skill.
    """
    if any(each.name == UNUSED_CONFLICT for each in before.found):
        return None  # after the edit the library may use what was in conflict
    edited = before.edited(library.sources)
    now = _outlines(edited, before, memo)
    if now is None:
        return None
    outlines = {**before.outlines, **now}
    dependencies = Dependencies(outlines)
    skills = dependencies.callers(changed_skills(before.outlines, now))
    checked = dependencies.concerned(skills) | edited.keys()
    described = changed_signatures(before.outlines, now)
    in_scenes = not checked.isdisjoint(before.texts) or not skills.isdisjoint(before.looked)
    if TASK in skills or in_scenes or (described and _has_calls(library)):
        return None
    own = {source.path: source for source in library.sources}
    needed = dependencies.needed(checked)
    if any(path not in own or "allow" in own[path].text for path in checked):
        return None
    shown = {library.display_path(path) for path in checked}
    of_scenes, names = before.of_scenes, _names_kept()
    kept = [each for each in before.found if each.span.path not in shown or each.name in names or each in of_scenes]
    moved = {(library.display_path(path), line) for path, line in changed_places(before.outlines, now)}
    if any(not moved.isdisjoint(_lines_of(each)) for each in kept):
        return None
    with gc_disabled():
        files = Slice([own[path] for path in sorted(needed & own.keys())], checked, needed, described)
        found = _check_slice(library, files, before, memo)
    return None if found is None else update_snapshot(before, edited, now, sort_diagnostics((*kept, *found)))


def recall_vocabulary(memo: Memo, own: tuple[Source, ...]) -> Vocabulary:
    """Return the shipped ontology together with others."""

    def load() -> Vocabulary:
        # The parser of Turtle and the checks of ontologies are slow to import.
        from skillc.services.library.libraries import load_vocabulary_with

        return load_vocabulary_with(own).value

    texts = [text for each in own for text in (each.path, each.text, str(each.unreadable))]
    return memo.ask("vocabulary", (memo.same("ontologies", "", own),), load, saved=lambda: texts)


class Slice(NamedTuple):
    """The files of a library that are checked again, and the `sources` and paths of all that are `needed` for that.

    `described` are the skills that have changed outside of bodies.
    """

    sources: list[Source]
    checked: frozenset[str]
    needed: frozenset[str]
    described: frozenset[str]


def _has_calls(library: LibraryFiles) -> bool:
    """Whether the manifest calls skills."""
    return library.project is not None and any(each.call for each in library.project.manifest.tasks.values())


def _lines_of(problem: Diagnostic) -> Iterator[tuple[str, int]]:
    """Yield the lines to which a diagnostic points."""
    for span in (problem.span, *(label.span for label in problem.labels)):
        yield from ((span.path, line) for line in range(span.line, span.end_line + 1))


def _outlines(edited: Mapping[str, Source], before: Snapshot, memo: Memo) -> dict[str, FileOutline] | None:
    """Return the outlines of edited files, None if one has errors or shows other files something else."""
    found = {}
    for path, source in edited.items():
        parsed = parse_with(memo, source)
        if parsed.diagnostics or parsed.value.errors:
            return None
        known = before.outlines[path]
        unit = ParsedFile(parsed.value, "", "", source.text)
        found[path] = msgspec.structs.replace(outline_of(unit), imports=known.imports)
        if found[path].shown != known.shown:
            return None
    return found


def _check_slice(library: LibraryFiles, files: Slice, before: Snapshot, memo: Memo) -> tuple[Diagnostic, ...] | None:
    """Return what is found in the files that are checked.

    None if there is an error, if needed files are not imported, or if the whole library reads something else.
    """
    vocabulary = recall_vocabulary(memo, library.vocabularies)
    read = read_sources(files.sources, library.importable, library.name, partial(parse_with, memo), library.namespaces)
    program = resolve_program(read.value, vocabulary, library.name, before.individuals_by_task)
    if not files.needed <= {unit.file.path for unit in read.value}:
        return None
    if not files.checked.isdisjoint(files_with_texts(program.value)):
        return None
    problems = find_problems(read, program, paths=files.checked)
    if any(problem.severity == "error" for problem in problems):
        return None
    if files.described and not _reads_the_same(program.value, files.described, before):
        return None
    here = [problem for problem in problems if problem.span.path in files.checked]
    return tuple(library.with_display_paths(each) for each in visible_diagnostics(here, files.sources))


def _reads_the_same(program: Program, skills: Iterable[str], before: Snapshot) -> bool:
    """Whether planners, and checks of the whole library, read the same of skills as before."""
    # After an edit of a body, this is not imported.
    from skillc_compiler.lower.library import lower_program

    views = digest_views(lower_program(program, ()), skills)
    return all(before.views.get(name) == view for name, view in views.items())


def _names_kept() -> frozenset[str]:
    """Return the diagnostics that do not depend on bodies."""
    return frozenset({UNPLANNABLE}).union(*(one.NAMES for one in load_checks() if one.READS is Reads.LIBRARY))
