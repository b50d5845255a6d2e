"""Finds and reads the files of a skill library; nothing heavy is imported here."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import skillc_skills
from skillc.services.errors import RequestError
from skillc.services.files import inspect_path
from skillc_compiler.emit.headers import is_generated
from skillc_dsl.encoding import MOST_BYTES, decode, read_file
from skillc_dsl.source import Source
from skillc_ontology import catalogue

SHIPPED = Path(skillc_skills.__path__[0])
_STDIN = Path("stdin.skill")
_VOCABULARY = re.compile(r"^[^#\n]*(?:owl:Ontology\b|owl#Ontology[>\"])", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class LibraryFiles:
    """The texts of a library: `sources` with paths relative to `root`; `importable`, other files to import, by name.

    `vocabularies` are the user's ontologies: those in the library's folder and those in the user's ontology folders.
    `places` are the files on disk of all these texts, by path.
    """

    name: str
    root: Path
    sources: tuple[Source, ...]
    importable: dict[str, Source]
    places: dict[str, Path]
    vocabularies: tuple[Source, ...] = ()

    def display_path(self, path: str) -> str:
        """Return a source's path as displayed: relative to the current folder, or absolute outside of it."""
        file, here = self.places.get(path) or catalogue.ROOT / path, Path.cwd()
        return str(file.relative_to(here) if file.is_relative_to(here) else file)


def find_library(path: Path) -> LibraryFiles:
    """Read the library in the folder `path`, the single file at `path`, or the shipped library of that name.

    RequestError for a path that is none of these, cannot be read, or has no `.skill` file.
    """
    found = inspect_path(path)
    if found.kind == "missing" and inspect_path(SHIPPED / path).kind == "folder":
        path, found = SHIPPED / path, inspect_path(SHIPPED / path)
    if found.kind == "missing":
        raise RequestError(f"there is no file or folder {path}")
    if found.kind == "unusable":
        raise RequestError(f"{path} {found.is_what}")
    if found.kind == "folder":
        files = {file.relative_to(path).as_posix(): file for file in sorted(_files_below(path))}
        sources = {shown: file for shown, file in files.items() if shown.endswith(".skill")}
        if not sources:
            raise RequestError(f"there is no .skill file in {path}")
        texts = tuple(_read(file, shown) for shown, file in sources.items())
        beside = {shown: file for shown, file in files.items() if is_vocabulary(file)}
        return _library(path.resolve().name, path, texts, sources, {}, beside)
    if path.suffix != ".skill":
        raise RequestError(f"{path} is not a .skill file")
    return read_single_file(path, _bytes(path))


def read_single_file(path: Path | None, content: bytes) -> LibraryFiles:
    """Return a library of one file at `path` (None: no file) with this content, which can import its neighbours."""
    path = path or _STDIN
    others = (file for file in sorted(path.parent.glob("*.skill")) if file.name != path.name and file.is_file())
    neighbours = {file.name: (file.name, file) for file in others}
    source = decode(path.name, content)
    beside = {file.name: file for file in sorted(path.parent.glob("*")) if is_vocabulary(file)}
    return _library(path.resolve().parent.name, path.parent, (source,), {path.name: path}, neighbours, beside)


def source_texts(library: LibraryFiles) -> dict[str, Source]:
    """Return every text of the library and of its possible imports, by displayed path."""
    every = (*library.sources, *library.importable.values(), *library.vocabularies)
    return {library.display_path(s.path): Source(library.display_path(s.path), s.text) for s in every}


def find_scene(scene: Path) -> Path:
    """Return a scene file: the path itself, or a shipped scene of that name."""
    found = inspect_path(scene)
    if found.kind == "file":
        return scene
    try:
        return catalogue.scene_path(str(scene))
    except FileNotFoundError as error:
        missing = f"there is no file {scene}, and {error}"
        raise RequestError(missing if found.kind == "missing" else f"{scene} {found.is_what}") from error


def user_vocabularies() -> dict[str, Path]:
    """Return the ontologies in the folders of `--ontology` and SKILLC_ONTOLOGY, by displayed path.

    RequestError for a folder that does not exist.
    """
    for folder in catalogue.user_folders():
        found = inspect_path(folder)
        if found.kind == "missing":
            raise RequestError(f"{catalogue.VARIABLE} names {folder}, which does not exist")
        if found.kind != "folder":
            raise RequestError(f"{catalogue.VARIABLE} names {folder}, which {found.is_what}")
    return dict(catalogue.user_files())


def is_vocabulary(path: Path) -> bool:
    """Whether a file is a vocabulary: it declares an owl:Ontology, which scenes do not, and skillc did not write it."""
    if path.suffix not in catalogue.ENDINGS:
        return False
    try:
        text = read_file(path).decode("utf-8", errors="replace")
    except OSError:
        return False
    return bool(_VOCABULARY.search(text)) and not is_generated(text)


def read_vocabularies(files: Iterable[tuple[str, Path]]) -> tuple[Source, ...]:
    """Read files; RequestError for one that cannot be read."""
    return tuple(decode(shown, _bytes(path, most=-1)) for shown, path in files)


def _library(
    name: str,
    root: Path,
    sources: tuple[Source, ...],
    places: Mapping[str, Path],
    neighbours: Mapping[str, tuple[str, Path]],
    beside: Mapping[str, Path],
) -> LibraryFiles:
    importable = {**_shipped(), **neighbours}
    texts = {wanted: _read(file, shown) for wanted, (shown, file) in sorted(importable.items())}
    vocabularies = {**user_vocabularies(), **beside}
    read = read_vocabularies(sorted(vocabularies.items()))
    return LibraryFiles(name, root, sources, texts, {**vocabularies, **dict(importable.values()), **places}, read)


def _shipped() -> dict[str, tuple[str, Path]]:
    """Return the shipped files by the name that imports them, with their displayed paths."""
    files = sorted(SHIPPED.glob("*/*.skill"))
    named = ((file, f"{file.parent.name}/{file.name}") for file in files)
    return {file.name if file.parent.name == "std" else shown: (shown, file) for file, shown in named}


def _files_below(folder: Path) -> Iterator[Path]:
    """Yield the files below a folder; hidden folders and links to folders are not entered."""
    for place, folders, names in os.walk(folder, onerror=_unreadable):
        folders[:] = [name for name in folders if not name.startswith(".")]
        yield from (Path(place, name) for name in names)


def _unreadable(error: OSError) -> None:
    raise RequestError(f"{error.filename} cannot be read: {error.strerror}") from error


def _read(file: Path, name: str) -> Source:
    return decode(name, _bytes(file))


def _bytes(file: Path, most: int = MOST_BYTES) -> bytes:
    try:
        return read_file(file, most)
    except OSError as error:
        raise RequestError(f"{file} cannot be read: {error.strerror}") from error
