"""Entries of caches on disk: where one is, and what may be read from it."""

from __future__ import annotations

import io
import pickle
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

import msgspec

from skillc.services.library.check_cache import digest_parts, installation_digest
from skillc_dsl import cache
from skillc_ontology.catalogue import user_models

if TYPE_CHECKING:
    from skillc_runtime.scene.load import Scene

IsPart: TypeAlias = Callable[[str, str], bool]
"""Whether a class, given by its module and its name, may be part of an entry."""


def find_entry(folder: str, parts: Iterable[str | bytes]) -> Path | None:
    """Return the path of the entry in a folder of the cache for everything that it depends on besides skillc itself.

    None if there is no cache.
    """
    base = cache.cache_folder()
    return None if base is None else base / folder / digest_parts((installation_digest(), *parts))


def describe_scene(scene: Scene) -> Iterator[str | bytes]:
    """Yield the terms, statements and models that what is found in a scene depends on."""
    yield encode_meaning(scene.state.vocabulary)
    for each in scene.said:
        yield f"{each.subject} {each.predicate} {each.object}"
    yield from describe_models()


def describe_models() -> Iterator[str | bytes]:
    """Yield the user's models of devices."""
    for model in user_models():
        yield str(model)
        yield model.read_bytes()


def encode_meaning(item: object) -> bytes:
    """Return structs as bytes that do not depend on where they stand in files."""
    return msgspec.json.encode(_without_positions(msgspec.to_builtins(item)), order="deterministic")


def _without_positions(item: object) -> object:
    match item:
        case {"path": str(), "line": int(), "column": int()}:
            return None
        case dict():
            return {name: _without_positions(each) for name, each in item.items()}
        case list() | tuple():
            return [_without_positions(each) for each in item]
        case _:
            return item


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
