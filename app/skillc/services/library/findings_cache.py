"""Caches what checks find in single files; the key of an entry is the digest of all files that the checks read for it.

What concerns the whole library, and which problems follow from others, is found anew each time.
"""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from skillc.services.library.cache_entries import read_pickled
from skillc_compiler.checks import FoundBy
from skillc_compiler.program.outlines import FileOutline, outline_of
from skillc_compiler.program.slices import Dependencies
from skillc_compiler.program.typed import Program
from skillc_dsl import cache
from skillc_dsl import syntax as s

_MOST = 200
"""The most entries in the cache; beyond it the older half is deleted."""


@dataclass
class FindingsCache:
    """What was found in the files of a library; `around` is the digest of all but its own files.

    `outlines` are those of the program that was looked up last.
    """

    around: str
    outlines: Mapping[str, FileOutline] = field(default_factory=dict)
    _keys: Mapping[str, str] = field(default_factory=dict)
    _found: Mapping[str, FoundBy] = field(default_factory=dict)

    def look_up(self, program: Program) -> Mapping[str, FoundBy]:
        """Return what is known of the files of a program, by path."""
        self.outlines = {unit.file.path: outline_of(unit) for unit in program.files}
        self._keys = dict(self._compute_keys(program))
        found = read_pickled(self._path(), _is_part)
        stored = found if isinstance(found, dict) else {}
        return {file: stored[key] for file, key in self._keys.items() if key in stored}

    def keep(self, found: Mapping[str, FoundBy]) -> None:
        """Keep what was found in the files of the program that was looked up last."""
        self._found = found

    def store(self) -> None:
        """Store what was kept, if anything was looked up."""
        path = self._path()
        if path is not None and self._keys:
            body = {key: self._found[file] for file, key in self._keys.items() if file in self._found}
            cache.store(path, pickle.dumps(body, protocol=5))
            cache.delete_oldest(path.parent, _MOST, _MOST // 2)

    def _compute_keys(self, program: Program) -> Iterator[tuple[str, str]]:
        """Yield the keys of files; none for a file for which something is read that is not clear."""
        if program.lost.twice or _has_function_twice(program):
            return
        unclear = {each.written.span.path for each in program.unknown}
        unclear |= {unit.file.path for unit in program.files if unit.file.errors}
        texts = {unit.file.path: f"{_digest(unit.text)} {len(unit.file.declarations)}" for unit in program.files}
        dependencies = Dependencies(self.outlines)
        for path in self.outlines:
            needed = dependencies.needed((path,))
            if needed.isdisjoint(unclear):
                read = (f"{each} {texts[each]}" for each in sorted(needed))
                yield path, _digest("\n".join((self.around, path, *read)))

    def _path(self) -> Path | None:
        folder = cache.cache_folder()
        return folder / "findings" / self.around if folder else None


def _is_part(module: str, _name: str) -> bool:
    """Whether a class is part of a diagnostic."""
    return module in ("skillc_dsl.diagnostics", "skillc_dsl.source")


def _has_function_twice(program: Program) -> bool:
    """Whether files declare functions of the same name, of which only one counts."""
    declared = (each for unit in program.files for each in unit.file.declarations)
    names = [each.name.text for each in declared if isinstance(each, s.FunctionDeclaration)]
    return len(names) > len(set(names))


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogateescape")).hexdigest()
