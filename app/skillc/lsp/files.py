"""Finds the files of a library: those on disk, replaced by the texts that are open in the editor."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from skillc.errors import DiagnosticsError
from skillc.services.library import files as library_files
from skillc.services.library.files import SHIPPED, LibraryFiles, find_library
from skillc.services.library.ontology_imports import follow_imports
from skillc.services.library.source_files import is_vocabulary_beside, read_vocabularies, user_vocabularies
from skillc.services.project import project as projects
from skillc.services.project.loading import find_project
from skillc_dsl.diagnostics import Outcome
from skillc_dsl.encoding import MOST_BYTES, decode, read_file
from skillc_dsl.source import Source, Span
from skillc_ontology import catalogue

_NOT_ENTERED = ("node_modules", "build", "dist", "out")


@dataclass(frozen=True, slots=True)
class Root:
    """The folder of a library. `whole`: subfolders belong to it too; not so outside the editor's folders."""

    folder: Path
    whole: bool

    def holds(self, file: Path) -> bool:
        """Whether a skill file belongs to the library."""
        return self.folder in file.parents if self.whole else file.parent == self.folder


def find_root(file: Path, folders: Sequence[Path]) -> Root:
    """Return the root of a file's library: the highest folder up to which every folder has a `.skill` file.

    The search stops at `folders`, those open in the editor. In a project it is the project's folder.
    """
    project = projects.find_root(file.parent)
    if project is not None:
        return Root(project, True)
    around = [folder for folder in folders if folder == file.parent or folder in file.parents]
    folder = file.parent
    while around and folder not in around and any(folder.parent.glob("*.skill")):
        folder = folder.parent
    return Root(folder, bool(around))


def read_sources(root: Root, buffers: Mapping[Path, str], edition: int) -> dict[str, Source]:
    """Return the texts of a library by path relative to its folder; `buffers` replace the files on disk."""
    own = [file for file in buffers if root.holds(file) and not is_rdf(file)]
    files = sorted({*_on_disk(root), *own})
    return {path: read_source(file, path, buffers, edition) for file, path in ((f, _relative(f, root)) for f in files)}


def is_rdf(file: Path) -> bool:
    """Whether the name of a file is that of a scene or a vocabulary."""
    return file.name.endswith(catalogue.ENDINGS)


def read_own_vocabularies(root: Root, around: LibraryFiles, buffers: Mapping[Path, str]) -> tuple[Source, ...]:
    """Return the vocabularies in a library's folder, in the user's ontology folders, and those `around` the library.

    `buffers` replace files on disk.
    """
    own = [file for file in list_rdf(root) if is_vocabulary_beside(file, around.project)]
    stated = {**user_vocabularies(), **{_relative(file, root): file for file in own}}
    home = library_files.Home(around.name, root.folder, around.project)
    places = follow_imports(stated, library_files.imports_of(home))
    read = {each.path: each for each in read_vocabularies(sorted(places.items()))}
    known = {**read, **{each.path: each for each in around.vocabularies if each.path not in read}}
    edited = {path: buffers[file] for path, file in {**around.places, **places}.items() if file in buffers}
    return tuple(each._replace(text=edited.get(each.path, each.text)) for each in known.values())


def list_rdf(root: Root) -> Iterator[Path]:
    """Yield the scenes and vocabularies in a library's folder, in order."""
    candidates = _below(root) if root.whole else root.folder.glob("*")
    yield from sorted(file for file in candidates if is_rdf(file) and file.is_file())


def find_file(path: str, root: Root, places: Mapping[str, Path]) -> Path:
    """Return the file of a diagnostic's path: in the library, at one of the `places` of others, or in the ontology."""
    if (root.folder / path).exists() or path not in places:
        ontology = catalogue.ROOT / path
        return ontology if ontology.is_file() and not (root.folder / path).exists() else root.folder / path
    return places[path]


def read_surroundings(root: Root) -> Outcome[LibraryFiles]:
    """Return what the files of a library may import, and its name; with the diagnostics of a broken manifest."""
    try:
        project = find_project(root.folder)
    except DiagnosticsError as error:
        found = [replace(each, span=_absolute(each.span)) for each in error.diagnostics]
        return Outcome(_shipped()._replace(name=root.folder.name), tuple(found))
    if project is None:
        return Outcome(_shipped()._replace(name=root.folder.name))
    return Outcome(library_files.read_surroundings(project))


def _absolute(span: Span) -> Span:
    return span._replace(path=str(Path(span.path).absolute()))


@cache
def _shipped() -> LibraryFiles:
    return find_library(SHIPPED / "std")


def _on_disk(root: Root) -> Iterator[Path]:
    if not root.whole:
        yield from (file for file in root.folder.glob("*.skill") if file.is_file())
        return
    yield from (file for file in _below(root) if file.name.endswith(".skill") and file.is_file())


def _below(root: Root) -> Iterator[Path]:
    in_project = (root.folder / projects.MANIFEST).is_file()
    for folder, folders, names in os.walk(root.folder):
        folders[:] = [name for name in folders if not name.startswith(".") and name not in _NOT_ENTERED]
        if in_project:
            folders[:] = [name for name in folders if not projects.is_nested_project(Path(folder, name))]
        yield from (Path(folder, name) for name in names)


def _relative(file: Path, root: Root) -> str:
    return file.relative_to(root.folder).as_posix()


def read_source(file: Path, path: str, buffers: Mapping[Path, str], edition: int) -> Source:
    """Return the text of a file, empty if the file cannot be read."""
    if file in buffers:
        return Source(path, buffers[file], edition=edition)
    try:
        return decode(path, read_file(file, MOST_BYTES))._replace(edition=edition)
    except OSError:
        return Source(path, "", edition=edition)
