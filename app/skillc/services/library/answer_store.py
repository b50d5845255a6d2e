"""The store of answers on disk, one for all processes of the user; nothing heavy is imported here.

The name of a file is the digest of everything that its answer depends on, and of the code that found it, so an outdated
answer is never read. What is damaged, or has other classes than those of data of this program, counts as absent.
"""

from __future__ import annotations

import dataclasses
import hashlib
import io
import os
import pickle
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from importlib import import_module
from pathlib import Path

import msgspec

from skillc_dsl import cache as files

PACKAGES = (
    *("skillc_dsl", "skillc_ontology", "skillc_rdf", "skillc_model", "skillc_compiler", "skillc_skills"),
    *("skillc_runtime", "skillc"),
)
_OURS = (
    *("skillc_dsl.", "skillc_rdf.", "skillc_model.", "skillc_compiler."),
    *("skillc_runtime.scene.violation", "skillc.services.check.snapshots", "skillc.services.tasks.space_problems"),
    "skillc.services.space.verdicts",
)
"""The modules of data in answers."""
_MOST = {"parse": 5000, "findings": 5000, "library": 100, "vocabulary": 100}
_MOST_OTHERWISE = 500
"""The most answers of a query; beyond it the older half is deleted."""


class AnswerStore:
    """The answers of queries as files in the cache folder, which are complete or absent; `flush` writes what is saved.

    Without a cache folder nothing is found; a folder that cannot be written only costs time.
    """

    def __init__(self) -> None:
        self._new: dict[Path, tuple[str, object]] = {}

    def load(self, query: str, inputs: Iterable[str | bytes]) -> object | None:
        """Return the answer for these inputs, None if there is none or it is damaged."""
        path = _find(query, inputs)
        name, answer = (self._new.get(path) or _read(path)) if path else ("", None)
        return answer if name == query else None

    def save(self, query: str, inputs: Iterable[str | bytes], answer: object) -> None:
        """Keep an answer."""
        path = _find(query, inputs)
        if path is not None:
            self._new[path] = query, answer

    def flush(self) -> None:
        """Write what was saved."""
        for path, entry in self._new.items():
            files.store(path, pickle.dumps(entry, protocol=5))
        # Names are digests: to look at a whole folder after one file of sixteen is enough, and takes milliseconds.
        for folder in {path.parent for path in self._new if path.name.startswith("0")}:
            most = _MOST.get(folder.name, _MOST_OTHERWISE)
            files.delete_oldest(folder, most, most // 2)
        self._new.clear()


def _find(query: str, inputs: Iterable[str | bytes]) -> Path | None:
    folder = files.cache_folder()
    return folder / query / digest_parts((installation_digest(), *inputs)) if folder else None


def _read(path: Path) -> tuple[str, object]:
    """Return the query and the answer of a file; an empty name if there is none, or not of this form."""
    body = files.load(path)
    try:
        match None if body is None else _Reader(io.BytesIO(body)).load():
            case (str(query), answer):
                return query, answer
    except (pickle.UnpicklingError, AttributeError, EOFError, ImportError, IndexError, TypeError, ValueError):
        pass
    return "", None


class _Reader(pickle.Unpickler):
    """Loads data of this program, and nothing else."""

    def find_class(self, module: str, name: str) -> object:
        found: object = super().find_class(module, name) if "." not in name and _is_ours(module) else None
        if module != "msgspec._utils" and not _is_data(found):
            raise pickle.UnpicklingError(f"{module}.{name} is no data")
        return found


def _is_ours(module: str) -> bool:
    return module.startswith(_OURS) or module == "msgspec._utils"


def _is_data(found: object) -> bool:
    return isinstance(found, type) and (issubclass(found, msgspec.Struct | tuple) or dataclasses.is_dataclass(found))


def digest_parts(parts: Iterable[str | bytes]) -> str:
    """Return the digest of texts and bytes, which depends on where each ends."""
    digest = hashlib.sha256()
    for part in parts:
        content = part if isinstance(part, bytes) else part.encode("utf-8", "surrogateescape")
        digest.update(b"%d:" % len(content) + content)
    return digest.hexdigest()


@cache
def installation_digest() -> bytes:
    """Return the digest of the state of skillc, Python and the installed packages when this process first looked.

    That is the code that it runs, mostly, whatever is installed meanwhile.
    """
    return hashlib.sha256("\n".join(describe_installation()).encode("utf-8", "surrogateescape")).digest()


def describe_installation() -> Iterator[str]:
    """Yield texts that identify the state of skillc, Python and the installed packages.

    What is read of the Python in projects is part of the inputs of their libraries.
    """
    yield sys.version
    for folder in filter(os.path.isdir, sys.path):
        if os.path.isfile(os.path.join(folder, "skillc.toml")):  # noqa: PTH113, PTH118
            continue
        yield f"{folder} {os.stat(folder).st_mtime_ns}"  # noqa: PTH116
    for package in PACKAGES:
        yield from _states(import_module(package).__path__[0])


def _states(folder: str) -> list[str]:
    """Return path, size and modification time of every file below a folder, without compiled Python, in order."""
    found, folders = [], [folder]
    while folders:
        with os.scandir(folders.pop()) as entries:
            inside = [(each, each.is_dir()) for each in entries]
        folders += [each.path for each, is_folder in inside if is_folder and each.name != "__pycache__"]
        states = ((each.path, each.stat()) for each, is_folder in inside if not is_folder)
        found += [f"{path} {state.st_size} {state.st_mtime_ns}" for path, state in states]
    return sorted(found)
