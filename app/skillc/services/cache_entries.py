"""Entries of caches on disk: where one is, and what may be read from it."""

from __future__ import annotations

import io
import pickle
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TypeAlias

from skillc.services.check_cache import digest_parts, installation_digest
from skillc_dsl import cache

IsPart: TypeAlias = Callable[[str, str], bool]
"""Whether a class, given by its module and its name, may be part of an entry."""


def find_entry(folder: str, parts: Iterable[str | bytes]) -> Path | None:
    """Return the path of the entry in a folder of the cache for everything that it depends on besides skillc itself.

    None if there is no cache.
    """
    base = cache.cache_folder()
    return None if base is None else base / folder / digest_parts((installation_digest(), *parts))


def read_pickled(path: Path | None, is_part: IsPart) -> object:
    """Return what an entry holds; None if there is none, if it is damaged, or has other classes than its parts."""
    body = None if path is None else cache.load(path)
    try:
        return None if body is None else _Reader(body, is_part).load()
    except (pickle.UnpicklingError, AttributeError, EOFError, ImportError, IndexError, TypeError, ValueError):
        return None


class _Reader(pickle.Unpickler):
    """Loads the classes that are parts of an entry, and no others."""

    def __init__(self, body: bytes, is_part: IsPart) -> None:
        super().__init__(io.BytesIO(body))
        self._is_part = is_part

    def find_class(self, module: str, name: str) -> object:
        if "." in name or not self._is_part(module, name):
            raise pickle.UnpicklingError(f"{module}.{name} is no part of this entry")
        return super().find_class(module, name)
