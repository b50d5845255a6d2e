"""Notices that files of a library have changed, without reading them, and that other Python code would be executed."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from hashlib import sha256
from importlib.machinery import PathFinder
from pathlib import Path
from typing import TypeAlias

from skillc.services.project.project import is_nested_project
from skillc_ontology import catalogue

ENDINGS = (".skill", ".py", ".toml", *catalogue.ENDINGS)
Stamp: TypeAlias = frozenset[tuple[str, int, int, int]]
"""The files of a library, each with the time of its last change in ns, its size and its number."""
_WORD = re.compile(rb"[A-Za-z_]\w*")


def read_stamp(folders: Iterable[str]) -> Stamp:
    """Return how the files in folders are now; hidden folders, other projects and environments are not entered."""
    files = (file for folder in folders for file in list_files(Path(folder), ENDINGS))
    return frozenset(each for file in files for each in _stamp_file(file))


def read_code(folders: Iterable[str]) -> dict[str, bytes]:
    """Return the content of the Python files in folders, by path; what is not entered is as for `read_stamp`."""
    files = (file for folder in folders for file in list_files(Path(folder), (".py",)))
    return {str(file): _read(file) for file in files}


@dataclass(frozen=True, slots=True)
class KnownCode:
    """The Python files with which a server was started: the digests of each by path, and all words in them."""

    digests: Mapping[str, str]
    words: frozenset[str]

    @staticmethod
    def note(code: Mapping[str, bytes]) -> KnownCode:
        """Note the files with this content."""
        words = {each.decode() for content in code.values() for each in _WORD.findall(content)}
        return KnownCode({path: sha256(content).hexdigest() for path, content in code.items()}, frozenset(words))

    def describe_changed(self, now: Mapping[str, bytes]) -> str:
        """Return which files are gone, have other content, or are new and could be imported by others; empty if none.

        A new file counts as imported by nothing if no known one names it and it takes the place of no other module.
        """
        digests = {path: sha256(content).hexdigest() for path, content in now.items()}
        gone = (path for path, digest in self.digests.items() if digests.get(path) != digest)
        new = (path for path in digests.keys() - self.digests.keys() if self._may_import(Path(path)))
        changed = sorted(Path(path).name for path in (*gone, *new))
        if not changed:
            return ""
        files = ", ".join(changed)
        return f"Python files have changed ({files}), which is not loaded; start the server again to use them"

    def _may_import(self, file: Path) -> bool:
        name = file.parent.name if file.stem == "__init__" else file.stem
        return name in self.words or _is_known_elsewhere(name, file)


def list_files(folder: Path, endings: tuple[str, ...]) -> Iterator[Path]:
    """Yield the files in a folder with these endings; hidden ones, other projects and environments are not entered."""
    for place, folders, names in os.walk(folder):
        inner = (each for each in folders if not each.startswith(".") and each != "__pycache__")
        folders[:] = [each for each in inner if not is_nested_project(Path(place, each))]
        yield from (Path(place, name) for name in names if name.endswith(endings))


def _stamp_file(file: Path) -> Iterator[tuple[str, int, int, int]]:
    try:
        about = file.stat()
    except OSError:
        return
    yield str(file), about.st_mtime_ns, about.st_size, about.st_ino


def _read(file: Path) -> bytes:
    try:
        return file.read_bytes()
    except OSError:
        return b""


def _is_known_elsewhere(name: str, file: Path) -> bool:
    """Whether a module with the name of a file is found elsewhere: the file could be imported in its place."""
    if name in sys.builtin_module_names or name in sys.stdlib_module_names:
        return True
    places = [each for each in sys.path if each and not file.is_relative_to(Path(each).resolve())]
    return PathFinder.find_spec(name, places) is not None
