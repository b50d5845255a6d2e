"""Caches vocabularies on disk; the key is the digest of the installation and of the ontologies that are not shipped."""

from __future__ import annotations

import pickle
from functools import lru_cache

from skillc.services.library.cache_entries import find_entry, read_pickled
from skillc_dsl import cache
from skillc_dsl.source import Source
from skillc_rdf.vocabulary.types import Vocabulary

_MOST = 100
"""The most entries in the cache; beyond it the older half is deleted."""


@lru_cache(4)
def load_vocabulary_once(own: tuple[Source, ...]) -> Vocabulary:
    """Return the shipped ontology together with others, from the cache if it is there."""
    path = find_entry("vocabularies", (text for each in own for text in (each.path, each.text, str(each.unreadable))))
    found = read_pickled(path, _is_part)
    if isinstance(found, Vocabulary):
        return found
    # The parser of Turtle and the checks of ontologies are slow to import.
    from skillc.services.library.libraries import load_vocabulary_with

    loaded = load_vocabulary_with(own).value
    if path:
        cache.store(path, pickle.dumps(loaded, protocol=5))
        cache.delete_oldest(path.parent, _MOST, _MOST // 2)
    return loaded


def _is_part(module: str, name: str) -> bool:
    """Whether a class is part of a vocabulary."""
    return module == "skillc_rdf.vocabulary.types" or (module, name) == ("msgspec._utils", "rebuild")
