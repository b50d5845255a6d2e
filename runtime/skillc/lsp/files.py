"""Which files a library has: those on disk, and the texts in the editor in their place."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from skillc.services.library_files import (
    SHIPPED,
    LibraryFiles,
    find_library,
    is_vocabulary,
    read_vocabularies,
    user_vocabularies,
)
from skillc_dsl.encoding import MOST_BYTES, decode, read_file
from skillc_dsl.source import Source
from skillc_ontology import catalogue

_NOT_ENTERED = ("node_modules", "build", "dist", "out")


@dataclass(frozen=True, slots=True)
class Root:
    """The folder of a library; outside of the editor's folders, only the files right in it belong to the library."""

    folder: Path
    whole: bool

    def holds(self, file: Path) -> bool:
        """Whether a file belongs to the library, if it is one of skills."""
        return self.folder in file.parents if self.whole else file.parent == self.folder


def root_of(file: Path, folders: Sequence[Path]) -> Root:
    """Return the library that a file belongs to: its folder, or the highest above it with a `.skill` file in each.

    `folders` are those open in the editor, beyond which nothing is looked for.
    """
    around = [folder for folder in folders if folder == file.parent or folder in file.parents]
    folder = file.parent
    while around and folder not in around and any(folder.parent.glob("*.skill")):
        folder = folder.parent
    return Root(folder, bool(around))


def sources(root: Root, buffers: Mapping[Path, str]) -> dict[str, Source]:
    """Return the texts of a library by path relative to its folder; `buffers` stand for what is on disk."""
    own = [file for file in buffers if root.holds(file) and not is_turtle(file)]
    files = sorted({*_on_disk(root), *own})
    return {path: _source(file, path, buffers) for file, path in ((f, _relative(f, root)) for f in files)}


def is_turtle(file: Path) -> bool:
    """Whether a file is a scene or a vocabulary by its name."""
    return file.suffix in catalogue.ENDINGS


def vocabularies(root: Root) -> tuple[Source, ...]:
    """Return the vocabularies beside the skills of a library, and those in the folders that were named."""
    candidates = _below(root) if root.whole else root.folder.glob("*")
    own = sorted(file for file in candidates if is_vocabulary(file))
    return read_vocabularies(sorted({**user_vocabularies(), **{_relative(file, root): file for file in own}}.items()))


def place(path: str, root: Root) -> Path:
    """Return the file of a path that a diagnostic shows: of the library, of a shipped library, or of the ontology."""
    shipped = _shipped().places
    if (root.folder / path).exists() or path not in shipped:
        ontology = catalogue.ROOT / path
        return ontology if ontology.is_file() and not (root.folder / path).exists() else root.folder / path
    return shipped[path]


def importable() -> Mapping[str, Source]:
    """Return the shipped files that every library may import."""
    return _shipped().importable


@cache
def _shipped() -> LibraryFiles:
    return find_library(SHIPPED / "std")


def _on_disk(root: Root) -> Iterator[Path]:
    if not root.whole:
        yield from (file for file in root.folder.glob("*.skill") if file.is_file())
        return
    yield from (file for file in _below(root) if file.name.endswith(".skill") and file.is_file())


def _below(root: Root) -> Iterator[Path]:
    for folder, folders, names in os.walk(root.folder):
        folders[:] = [name for name in folders if not name.startswith(".") and name not in _NOT_ENTERED]
        yield from (Path(folder, name) for name in names)


def _relative(file: Path, root: Root) -> str:
    return file.relative_to(root.folder).as_posix()


def _source(file: Path, path: str, buffers: Mapping[Path, str]) -> Source:
    """Return a text; a file that has gone in the meantime is empty."""
    if file in buffers:
        return Source(path, buffers[file])
    try:
        return decode(path, read_file(file, MOST_BYTES))
    except OSError:
        return Source(path, "")
