"""Applies the fixes of diagnostics: to a library until none is left, then to its scenes and vocabularies."""

from __future__ import annotations

import difflib
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from skillc.errors import RequestError
from skillc.services.check.checking import STDIN, CheckRequest, check_with_cache, read_libraries
from skillc.services.library.files import SHIPPED, LibraryFiles
from skillc.services.reporting.files import rewrite_file
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.edits import apply_fixes, drop_overlapping
from skillc_dsl.encoding import decode, split_lines, unpack
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source
from skillc_ontology import catalogue

_ROUNDS = 20
"""The most times that a library is fixed and checked again."""


@dataclass(frozen=True, slots=True)
class FileChange:
    """A file's text before and after its fixes; `shown` is its path relative to the current folder."""

    path: Path
    shown: str
    before: str
    after: str


@dataclass(frozen=True, slots=True)
class Fixes:
    """The result of fixing: libraries, remaining diagnostics, changed files, and the number of fixed problems.

    `skills` are the changes of skill files, `beside` those of scenes and vocabularies.
    """

    libraries: tuple[LibraryFiles, ...]
    remaining: tuple[Diagnostic, ...]
    skills: tuple[FileChange, ...]
    beside: tuple[FileChange, ...]
    count: int

    def diff(self) -> str:
        """Return the changes as a unified diff."""
        return "".join(unified_diff(each.before, each.after, each.shown) for each in (*self.skills, *self.beside))


def find_fixes(request: CheckRequest, unsafe: bool) -> Fixes:
    """Return the changes by the safe fixes, or by all; nothing is written. RequestError for shipped libraries."""
    read = read_libraries(request)
    for library in read:
        if library.root.resolve().is_relative_to(SHIPPED):
            raise RequestError(f"the shipped library {library.name} cannot be changed; copy it and fix the copy")
    if STDIN in request.paths and len(read) > 1:
        raise RequestError("with fixes, `-` must be the only path")
    fixed = [_fix_library(library, lambda files: check_with_cache(request, files), unsafe) for library in read]
    remaining = tuple(problem for each in fixed for problem in each.remaining)
    beside = {} if STDIN in request.paths else _fixes_beside(remaining, unsafe)
    return Fixes(
        tuple(each.after for each in fixed),
        remaining,
        tuple(change for before, each in zip(read, fixed, strict=True) for change in _changes(before, each.after)),
        tuple(_change(path, chosen) for path, chosen in beside.items()),
        sum(each.count for each in fixed) + sum(map(len, beside.values())),
    )


def write_fixes(fixes: Fixes) -> int:
    """Write the changed files and return their number. ServiceError at the first that cannot be written."""
    changes = (*fixes.skills, *fixes.beside)
    for each in changes:
        rewrite_file(each.path, each.before, each.after)
    return len(changes)


def unified_diff(old: str, new: str, shown: str, shown_after: str | None = None, context: int = 2) -> str:
    """Return the change of a text as a unified diff, with `context` lines of context."""
    lines = difflib.unified_diff(split_lines(old), split_lines(new), shown, shown_after or shown, n=context)
    return "".join(line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in lines)


@dataclass(frozen=True, slots=True)
class _Fixed:
    after: LibraryFiles
    count: int
    remaining: tuple[Diagnostic, ...]


def _fix_library(
    library: LibraryFiles, check: Callable[[LibraryFiles], tuple[Diagnostic, ...]], unsafe: bool
) -> _Fixed:
    """Apply fixes to the sources of a library and check again, until no fix is left."""
    after, count, found = library, 0, check(library)
    seen = {library.sources}
    for _ in range(_ROUNDS):
        better, fixes = _apply_once(after, found, unsafe)
        if not fixes or better.sources in seen:
            break
        after, count = better, count + fixes
        seen.add(after.sources)
        found = check(after)
    return _Fixed(after, count, found)


def _apply_once(library: LibraryFiles, found: Sequence[Diagnostic], unsafe: bool) -> tuple[LibraryFiles, int]:
    """Return the library with all fixes that do not overlap applied once, and their number."""
    fixes: dict[str, list[Fix]] = defaultdict(list)
    for fix in _chosen(found, unsafe):
        fixes[fix.span.path].append(fix)
    sources, count = [], 0
    for source in library.sources:
        fitting = _fitting(source, drop_overlapping(fixes[library.display_path(source.path)]))
        sources.append(source._replace(text=apply_fixes(source.text, fitting)))
        count += len(fitting)
    return library._replace(sources=tuple(sources)), count


def _chosen(found: Iterable[Diagnostic], unsafe: bool) -> Iterator[Fix]:
    return (each.fix for each in found if each.fix is not None and (each.fix.safe or unsafe))


def _fitting(source: Source, fixes: Sequence[Fix]) -> Sequence[Fix]:
    """Return the fixes that do not add syntax errors."""
    if not fixes or source.unreadable:
        return ()
    most = _count_errors(source, ())
    if _count_errors(source, fixes) <= most:
        return fixes
    chosen: list[Fix] = []
    for fix in fixes:
        if _count_errors(source, [*chosen, fix]) <= most:
            chosen.append(fix)
    return chosen


def _count_errors(source: Source, fixes: Sequence[Fix]) -> int:
    problems = parse(source._replace(text=apply_fixes(source.text, fixes))).diagnostics
    return sum(problem.severity == "error" for problem in problems)


def _changes(before: LibraryFiles, after: LibraryFiles) -> Iterator[FileChange]:
    for old, new in zip(before.sources, after.sources, strict=True):
        if old != new:
            yield FileChange(after.places[new.path], after.display_path(new.path), old.text, new.text)


def _fixes_beside(found: Iterable[Diagnostic], unsafe: bool) -> dict[Path, Sequence[Fix]]:
    """Return the fixes of the user's own scenes and vocabularies, by file."""
    fixes: dict[Path, list[Fix]] = defaultdict(list)
    for fix in _chosen(found, unsafe):
        if _is_own_turtle(Path(fix.span.path)):
            fixes[Path(fix.span.path)].append(fix)
    readable = {path: each for path, each in sorted(fixes.items()) if not _read(path).unreadable}
    return {path: drop_overlapping(dict.fromkeys(each)) for path, each in readable.items()}


def _change(path: Path, fixes: Sequence[Fix]) -> FileChange:
    text = _read(path).text
    return FileChange(path, str(path), text, apply_fixes(text, fixes))


def _is_own_turtle(path: Path) -> bool:
    turtle = path.name.endswith(catalogue.ENDINGS) and path.is_file()
    return turtle and not path.resolve().is_relative_to(catalogue.ROOT.resolve())


def _read(path: Path) -> Source:
    return decode(str(path), unpack(path.read_bytes()))
