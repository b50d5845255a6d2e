"""Compiles libraries without errors, and caches them on disk; the key is the digest of all that compiling reads."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from skillc.errors import DiagnosticsError
from skillc.services.library.check_cache import CheckCacheEntry
from skillc.services.library.files import LibraryFiles, source_texts
from skillc_dsl import cache
from skillc_model import codec
from skillc_model.skills import SkillLibrary

_MOST = 100
"""The most entries in the cache; beyond it the older half is deleted."""


def compile_valid(files: LibraryFiles) -> SkillLibrary:
    """Return a library that has no errors, from the cache if it is there; DiagnosticsError if it has errors."""
    entry = CheckCacheEntry.of(files, None)
    path = _path(entry)
    found = None if path is None else _load(path)
    if found is not None:
        return found
    library = _compile(files)
    if path is not None and entry.is_current():
        cache.store(path, codec.dumps_as_written(library))
        cache.delete_oldest(path.parent, _MOST, _MOST // 2)
    return library


def _compile(files: LibraryFiles) -> SkillLibrary:
    # The compiler is slow to import.
    from skillc.services.library.libraries import compile_library

    outcome = compile_library(files)
    if not outcome.ok:
        raise DiagnosticsError(outcome.diagnostics, source_texts(files))
    return outcome.value


def _load(path: Path) -> SkillLibrary | None:
    body = cache.load(path)
    with suppress(codec.LibraryError):  # it is compiled again
        return None if body is None else codec.loads(body, str(path))
    return None


def _path(entry: CheckCacheEntry) -> Path | None:
    folder = cache.cache_folder()
    return None if folder is None else folder / "libraries" / entry.digest
