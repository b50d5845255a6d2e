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
    return frozenset(each for folder in folders for each in _stamp_folder(Path(folder)))


def read_code(folders: Iterable[str], modules: Iterable[str]) -> dict[str, str]:
    """Return the digests of the Python files of modules in folders, and of those beside them, by path."""
    places = {Path(folder, *each.split(".")) for folder in folders for each in modules}
    files = {file for each in places for file in (each.with_suffix(".py"), each / "__init__.py") if file.is_file()}
    return {str(file): _digest(file) for each in files for file in each.parent.glob("*.py")}


def describe_changed(code: Mapping[str, str]) -> str:
    """Return which of the files have other content than their digests say; empty if none."""
    changed = [Path(path).name for path, digest in sorted(code.items()) if _digest(Path(path)) != digest]
    if not changed:
        return ""
    return f"Python files have changed ({', '.join(changed)}), which is not loaded; start the server again to use them"


def _stamp_folder(folder: Path) -> Iterator[tuple[str, int, int, int]]:
    for place, folders, names in os.walk(folder):
        inner = (each for each in folders if not each.startswith("."))
        folders[:] = [each for each in inner if not is_nested_project(Path(place, each))]
        for name in names:
            if name.endswith(ENDINGS):
                yield from _stamp_file(Path(place, name))


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
