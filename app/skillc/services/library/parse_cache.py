"""Caches syntax trees on disk, so that after a change only the changed files of a library are parsed.

The key of an entry is the digest of the text, its path and the installation, so an outdated entry is never found.
"""

from __future__ import annotations

import pickle
from functools import lru_cache
from pathlib import Path

from skillc.services.library.cache_entries import find_entry, read_pickled
from skillc_dsl import cache
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Outcome
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source

_FOLDER = "parsed"
_MOST = 5000
"""The most entries in the cache; beyond it the older half is deleted."""
_MOST_IN_MEMORY = 2000


@lru_cache(_MOST_IN_MEMORY)
def parse_cached(source: Source) -> Outcome[s.File]:
    """Return what `parse` returns, from memory or from the cache folder if it is there."""
    path = find_entry(_FOLDER, (source.path, source.text, str(source.unreadable), str(source.edition)))
    found = read_pickled(path, _is_part)
    if isinstance(found, Outcome) and isinstance(found.value, s.File):
        return found
    parsed = parse(source)
    if path is not None:
        cache.store(path, pickle.dumps(parsed, protocol=5))
    return parsed


def delete_oldest_entries() -> None:
    """Delete the older half of the entries if there are too many."""
    folder: Path | None = cache.cache_folder()
    if folder is not None:
        cache.delete_oldest(folder / _FOLDER, _MOST, _MOST // 2)


def _is_part(module: str, _name: str) -> bool:
    """Whether a class is part of a syntax tree or a diagnostic."""
    return module.startswith("skillc_dsl.")
