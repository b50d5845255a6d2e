"""Notices that files of a library have changed, without reading them, and that Python files have other content."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from hashlib import sha256
from pathlib import Path
from typing import TypeAlias

from skillc.services.project.project import is_nested_project
from skillc_ontology import catalogue

ENDINGS = (".skill", ".py", ".toml", *catalogue.ENDINGS)
Stamp: TypeAlias = frozenset[tuple[str, int, int, int]]
"""The files of a library, each with the time of its last change in ns, its size and its number."""


def read_stamp(folders: Iterable[str]) -> Stamp:
    """Return how the files in folders are now; hidden folders, other projects and environments are not entered."""
    files = (file for folder in folders for file in list_files(Path(folder), ENDINGS))
    return frozenset(each for file in files for each in _stamp_file(file))


def read_code(folders: Iterable[str]) -> dict[str, str]:
    """Return the digests of the Python files in folders, by path; what is not entered is as for `read_stamp`."""
    files = (file for folder in folders for file in list_files(Path(folder), (".py",)))
    return {str(file): _digest(file) for file in files}


def describe_changed(before: Mapping[str, str], now: Mapping[str, str]) -> str:
    """Return which Python files are new, are gone, or have other content than before; empty if none."""
    changed = sorted(Path(path).name for path in before.keys() | now.keys() if before.get(path) != now.get(path))
    if not changed:
        return ""
    return f"Python files have changed ({', '.join(changed)}), which is not loaded; start the server again to use them"


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


def _digest(file: Path) -> str:
    try:
        return sha256(file.read_bytes()).hexdigest()
    except OSError:
        return ""
