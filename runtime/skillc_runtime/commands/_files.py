"""Finding and reading the files of a skill library, without the compiler: nothing heavy is imported here."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import click

import skillc_skills
from skillc_dsl.encoding import MOST_BYTES, decode, read_file
from skillc_dsl.source import Source
from skillc_runtime.commands import _ontologies
from skillc_runtime.commands._paths import look

SHIPPED = Path(skillc_skills.__path__[0])
_STDIN = Path("stdin.skill")


@dataclass(frozen=True, slots=True)
class LibraryFiles:
    """A library: `sources` under paths relative to `root`, `shelf` what may be imported besides, by name.

    `vocabularies` are ontologies of the user's: those beside the skills, and those in the folders that were named.
    `places` are the files of all of them on disk.
    """

    name: str
    root: Path
    sources: tuple[Source, ...]
    shelf: dict[str, Source]
    places: dict[str, Path]
    vocabularies: tuple[Source, ...] = ()

    def shown(self, path: str) -> str:
        """Return a source's path as a user can open it from here; ontology files are below the ontology."""
        file, here = self.places.get(path) or _in_ontology(path), Path.cwd()
        return str(file.relative_to(here) if file.is_relative_to(here) else file)


def find(path: Path) -> LibraryFiles:
    """Read the library at a folder, the single file at `path` with its neighbours, or the shipped library of that name.

    UsageError for a path that is none of these, that cannot be read, or that holds no `.skill` file.
    """
    found = look(path)
    if found.kind == "missing" and look(SHIPPED / path).kind == "folder":
        path, found = SHIPPED / path, look(SHIPPED / path)
    if found.kind == "missing":
        raise click.UsageError(f"there is no file or folder {path}")
    if found.kind == "unusable":
        raise click.UsageError(f"{path} {found.is_what}")
    if found.kind == "folder":
        sources = {file.relative_to(path).as_posix(): file for file in sorted(_skill_files(path))}
        if not sources:
            raise click.UsageError(f"there is no .skill file in {path}")
        texts = tuple(_read(file, shown) for shown, file in sources.items())
        return _library(path.resolve().name, path, texts, sources, {}, _vocabularies(path))
    if path.suffix != ".skill":
        raise click.UsageError(f"{path} is not a .skill file")
    return of_file(path, _bytes(path))


def of_file(path: Path | None, content: bytes) -> LibraryFiles:
    """Take `content` as that of the file at `path`, which can import its neighbours there; None for a file nowhere."""
    path = path or _STDIN
    others = (file for file in sorted(path.parent.glob("*.skill")) if file.name != path.name and file.is_file())
    neighbours = {file.name: (file.name, file) for file in others}
    source = decode(path.name, content)
    beside = {file.name: file for file in sorted(path.parent.glob("*")) if _ontologies.is_vocabulary(file)}
    return _library(path.resolve().parent.name, path.parent, (source,), {path.name: path}, neighbours, beside)


def texts(library: LibraryFiles) -> dict[str, Source]:
    """Return every text of the library and its shelf, by the path that diagnostics show."""
    every = (*library.sources, *library.shelf.values(), *library.vocabularies)
    return {library.shown(s.path): Source(library.shown(s.path), s.text) for s in every}


def scene_path(scene: Path) -> Path:
    """Return a scene file: the path itself, or a shipped scene of that name."""
    from skillc_ontology import catalogue

    found = look(scene)
    if found.kind == "file":
        return scene
    try:
        return catalogue.scene(str(scene))
    except FileNotFoundError as error:
        missing = f"there is no file {scene}, and {error}"
        raise click.UsageError(missing if found.kind == "missing" else f"{scene} {found.is_what}") from error


def piped() -> bytes:
    """Return what comes from the standard input; UsageError where it cannot be read."""
    try:
        return sys.stdin.buffer.read(MOST_BYTES)
    except OSError as error:
        raise click.UsageError(f"the standard input cannot be read: {error.strerror}") from error


def _library(
    name: str,
    root: Path,
    sources: tuple[Source, ...],
    places: Mapping[str, Path],
    neighbours: Mapping[str, tuple[str, Path]],
    beside: Mapping[str, Path],
) -> LibraryFiles:
    shelf = {**_shipped(), **neighbours}
    shelf_sources = {wanted: _read(file, shown) for wanted, (shown, file) in sorted(shelf.items())}
    vocabularies = {**_ontologies.named(), **beside}
    read = _ontologies.sources(sorted(vocabularies.items()))
    return LibraryFiles(name, root, sources, shelf_sources, {**vocabularies, **dict(shelf.values()), **places}, read)


def _shipped() -> dict[str, tuple[str, Path]]:
    """Return the shipped files by the name that imports them, with the path that is shown."""
    files = sorted(SHIPPED.glob("*/*.skill"))
    named = ((file, f"{file.parent.name}/{file.name}") for file in files)
    return {file.name if file.parent.name == "std" else shown: (shown, file) for file, shown in named}


def _vocabularies(folder: Path) -> dict[str, Path]:
    """Return the vocabularies among the files of a library."""
    found = sorted(file for file in _files_below(folder) if _ontologies.is_vocabulary(file))
    return {file.relative_to(folder).as_posix(): file for file in found}


def _skill_files(folder: Path) -> Iterator[Path]:
    """Yield the `.skill` files below a folder."""
    yield from (file for file in _files_below(folder) if file.name.endswith(".skill"))


def _files_below(folder: Path) -> Iterator[Path]:
    """Yield the files below a folder; hidden folders and links to folders are not entered."""
    for place, folders, names in os.walk(folder, onerror=_unreadable):
        folders[:] = [name for name in folders if not name.startswith(".")]
        yield from (Path(place, name) for name in names)


def _unreadable(error: OSError) -> None:
    raise click.UsageError(f"{error.filename} cannot be read: {error.strerror}") from error


def _read(file: Path, name: str) -> Source:
    return decode(name, _bytes(file))


def _bytes(file: Path) -> bytes:
    try:
        return read_file(file, MOST_BYTES)
    except OSError as error:
        raise click.UsageError(f"{file} cannot be read: {error.strerror}") from error


def _in_ontology(path: str) -> Path:
    from skillc_ontology import catalogue

    return catalogue.ROOT / path
