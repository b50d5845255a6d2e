"""Caches vocabularies on disk; the key is the digest of the installation and of the ontologies that are not shipped."""

from __future__ import annotations

import hashlib
import io
import pickle
from functools import lru_cache
from pathlib import Path

from skillc.services.check_cache import installation_digest
from skillc_dsl import cache
from skillc_dsl.source import Source
from skillc_rdf.vocabulary.types import Vocabulary

_MOST = 100
"""The most entries in the cache; beyond it the older half is deleted."""


@lru_cache(4)
def load_vocabulary_once(own: tuple[Source, ...]) -> Vocabulary:
    """Return the shipped ontology together with others, from the cache if it is there."""
    path = _entry(own)
    found = _read(cache.load(path)) if path else None
    if found is None:
        # The parser of Turtle and the checks of ontologies are slow to import.
        from skillc.services.libraries import load_vocabulary_with

        found = load_vocabulary_with(own).value
        if path:
            cache.store(path, pickle.dumps(found, protocol=5))
            cache.delete_oldest(path.parent, _MOST, _MOST // 2)
    return found


class _Reader(pickle.Unpickler):
    """Reads vocabularies; the cache holds nothing else, and no other class is loaded from it."""

    def find_class(self, module: str, name: str) -> object:
        if (module != "skillc_rdf.vocabulary.types" or "." in name) and (module, name) != ("msgspec._utils", "rebuild"):
            raise pickle.UnpicklingError(f"{module}.{name} is no part of a vocabulary")
        return super().find_class(module, name)


def _read(body: bytes | None) -> Vocabulary | None:
    if body is None:
        return None
    try:
        found = _Reader(io.BytesIO(body)).load()
    except (pickle.UnpicklingError, AttributeError, EOFError, ImportError, IndexError, TypeError, ValueError):
        return None
    return found if isinstance(found, Vocabulary) else None


def _entry(own: tuple[Source, ...]) -> Path | None:
    folder = cache.cache_folder()
    if folder is None:
        return None
    digest = hashlib.sha256(installation_digest())
    for part in (text for source in own for text in (source.path, source.text)):
        content = part.encode("utf-8", "surrogateescape")
        digest.update(b"%d:" % len(content) + content)
    return folder / "vocabularies" / digest.hexdigest()
