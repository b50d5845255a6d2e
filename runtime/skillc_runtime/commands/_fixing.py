"""Curing what can be cured: fixes applied to a library until none is left, its files written or shown as a diff."""

from __future__ import annotations

import difflib
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.edits import apply_fixes, drop_overlapping
from skillc_dsl.encoding import REPLACEMENT, split_lines
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source
from skillc_runtime.commands._files import LibraryFiles
from skillc_runtime.commands._writing import rewrite

_ROUNDS = 20
"""Fixes that make room for others are followed so often at most."""
Check = Callable[[LibraryFiles], Sequence[Diagnostic]]


@dataclass(frozen=True, slots=True)
class Cured:
    """A library after its fixes, how many they were, and what is still wrong with it."""

    before: LibraryFiles
    after: LibraryFiles
    fixes: int
    remaining: tuple[Diagnostic, ...]

    def changes(self) -> Iterator[tuple[Source, Source]]:
        """Yield the sources that changed, before and after."""
        for old, new in zip(self.before.sources, self.after.sources, strict=True):
            if old != new:
                yield old, new


def cure(library: LibraryFiles, check: Check, unsafe: bool) -> Cured:
    """Apply the safe fixes, or all of them, to the sources of a library, and to what is found then, and so on."""
    after, count = library, 0
    seen = {library.sources}
    found = tuple(check(library))
    for _ in range(_ROUNDS):
        better, fixes = _improved(after, found, unsafe)
        if not fixes or better.sources in seen:
            break
        after, count = better, count + fixes
        seen.add(after.sources)
        found = tuple(check(after))
    return Cured(library, after, count, found)


def write(cured: Cured) -> tuple[Path, ...]:
    """Write the sources that changed and return their files. WriteError at the first that cannot be written."""
    written = []
    for old, new in cured.changes():
        path = cured.after.places[new.path]
        rewrite(path, old.text, new.text)
        written.append(path)
    return tuple(written)


def diff(cured: Cured) -> str:
    """Return the changes as a unified diff."""
    return "".join(unified(old.text, new.text, cured.after.shown(new.path)) for old, new in cured.changes())


def unified(old: str, new: str, shown: str) -> str:
    """Return how a text, called `shown`, changes, as a unified diff."""
    lines = difflib.unified_diff(split_lines(old), split_lines(new), shown, shown, n=2)
    return "".join(line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in lines)


def _improved(library: LibraryFiles, found: Sequence[Diagnostic], unsafe: bool) -> tuple[LibraryFiles, int]:
    """Return the library with all fixes that go together applied once, and their number."""
    fixes: dict[str, list[Fix]] = defaultdict(list)
    for fix in (each.fix for each in found):
        if fix is not None and (fix.safe or unsafe):
            fixes[fix.span.path].append(fix)
    sources, count = [], 0
    for source in library.sources:
        chosen = _fitting(source, drop_overlapping(fixes[library.shown(source.path)]))
        sources.append(replace(source, text=apply_fixes(source.text, chosen)))
        count += len(chosen)
    return replace(library, sources=tuple(sources)), count


def _fitting(source: Source, fixes: Sequence[Fix]) -> Sequence[Fix]:
    """Return those of the fixes after which the file is read with no more errors than before."""
    if not fixes or REPLACEMENT in source.text:
        return ()
    most = _errors(source, ())
    if _errors(source, fixes) <= most:
        return fixes
    chosen: list[Fix] = []
    for fix in fixes:
        if _errors(source, [*chosen, fix]) <= most:
            chosen.append(fix)
    return chosen


def _errors(source: Source, fixes: Sequence[Fix]) -> int:
    problems = parse(replace(source, text=apply_fixes(source.text, fixes))).diagnostics
    return sum(problem.severity == "error" for problem in problems)
