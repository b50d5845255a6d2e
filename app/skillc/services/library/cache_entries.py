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
    from skillc_runtime.scene.load import LoadedScene

_PACKAGES = ("skillc_dsl.", "skillc_rdf.", "skillc_model.", "skillc_compiler.", "skillc_runtime.scene.violation")
_MOST = 5000
"""The most entries in a folder; beyond it the older half is deleted."""
IsPart: TypeAlias = Callable[[str, str], bool]
"""Whether a class, given by its module and its name, may be part of an entry."""


def find_entry(folder: str, parts: Iterable[str | bytes]) -> Path | None:
    """Return the path of the entry in a folder of the cache for everything that it depends on besides skillc itself.

    None if there is no cache.
    """
    base = cache.cache_folder()
    return None if base is None else base / folder / digest_parts((installation_digest(), *parts))


def describe_scene(scene: LoadedScene) -> Iterator[str | bytes]:
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


class DiskStore:
    """Answers of queries as files in the cache folder: complete or absent, and those of other versions are not found.

    What is saved is written by `flush`.
    """

    def __init__(self) -> None:
        self._new: dict[Path, tuple[str, object]] = {}

    def load(self, query: str, inputs: Iterable[str | bytes]) -> object | None:
        """Return the answer for these inputs, None if there is none or it is damaged."""
        path = find_entry(query, inputs)
        if path in self._new:
            return self._new[path][1]
        match read_pickled(path, _is_ours):
            case (str(name), answer) if name == query:
                return answer
            case _:
                return None

    def save(self, query: str, inputs: Iterable[str | bytes], answer: object) -> None:
        """Keep an answer."""
        path = find_entry(query, inputs)
        if path is not None:
            self._new[path] = query, answer

    def flush(self) -> None:
        """Write what was saved, and delete the older half of a folder that has too many entries."""
        for path, entry in self._new.items():
            cache.store(path, pickle.dumps(entry, protocol=5))
        for folder in {path.parent for path in self._new}:
            cache.delete_oldest(folder, _MOST, _MOST // 2)
        self._new.clear()


def _is_ours(module: str, _name: str) -> bool:
    return module.startswith(_PACKAGES) or module == "msgspec._utils"


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
        found: object = super().find_class(module, name)
        if not isinstance(found, type) and module != "msgspec._utils":
            raise pickle.UnpicklingError(f"{module}.{name} is not a class")
        return found
