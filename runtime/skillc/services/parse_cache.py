"""Caches syntax trees on disk, so that after a change only the changed files of a library are parsed.

The key of an entry is the digest of the text, its path and the installation, so an outdated entry is never found.
"""

from __future__ import annotations

import hashlib
import io
import pickle
from functools import lru_cache
from pathlib import Path

from skillc.services.check_cache import installation_digest
from skillc_dsl import cache as files
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Outcome
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source

_MOST = 5000
"""The most entries in the cache; beyond it the older half is deleted."""
_MOST_IN_MEMORY = 2000


@lru_cache(_MOST_IN_MEMORY)
def parse_cached(source: Source) -> Outcome[s.File]:
    """Return what `parse` returns, from memory or from the cache folder if it is there."""
    path = _entry(source)
    if path is None:
        return parse(source)
    found = _read(files.load(path))
    if found is not None:
        return found
    parsed = parse(source)
    files.store(path, pickle.dumps(parsed, protocol=5))
    return parsed


def delete_oldest_entries() -> None:
    """Delete the older half of the entries if there are too many."""
    folder = _folder()
    if folder is not None:
        files.delete_oldest(folder, _MOST, _MOST // 2)


class _Reader(pickle.Unpickler):
    """Reads syntax trees and diagnostics; the cache holds nothing else, and no other class is loaded from it."""

    def find_class(self, module: str, name: str) -> object:
        if not module.startswith("skillc_dsl.") or "." in name:
            raise pickle.UnpicklingError(f"{module}.{name} is no part of a syntax tree")
        return super().find_class(module, name)


def _read(body: bytes | None) -> Outcome[s.File] | None:
    if body is None:
        return None
    try:
        found = _Reader(io.BytesIO(body)).load()
    except (pickle.UnpicklingError, AttributeError, EOFError, ImportError, IndexError, TypeError, ValueError):
        return None
    return found if isinstance(found, Outcome) and isinstance(found.value, s.File) else None


def _entry(source: Source) -> Path | None:
    folder = _folder()
    if folder is None:
        return None
    digest = hashlib.sha256(installation_digest())
    for part in (source.path, source.text):
        content = part.encode("utf-8", "surrogateescape")
        digest.update(b"%d:" % len(content) + content)
    return folder / digest.hexdigest()


def _folder() -> Path | None:
    folder = files.cache_folder()
    return folder / "parsed" if folder else None
