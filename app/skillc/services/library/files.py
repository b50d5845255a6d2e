"""Finds and reads the files of a skill library; nothing heavy is imported here."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from skillc.errors import RequestError
from skillc.services.library.ontology_imports import follow_imports
from skillc.services.library.source_files import (
    is_vocabulary_beside,
    list_files_below,
    list_files_in,
    read_content,
    read_source,
    read_vocabularies,
    user_vocabularies,
)
from skillc.services.project import project as projects
from skillc.services.project.loading import find_project
from skillc.services.project.project import DEFAULT_BACKEND, SYMBOLIC, Project
from skillc.services.reporting.files import inspect_path
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.editions import FIRST, NEWEST
from skillc_dsl.encoding import decode
from skillc_dsl.source import Source, Span
from skillc_ontology import catalogue

SHIPPED = projects.SHIPPED
_STDIN = Path("stdin.skill")


class LibraryFiles(NamedTuple):
    """The texts of a library: `sources` with paths relative to `root`; `importable`, other files to import, by name.

    `vocabularies` are the user's ontologies: those in the library's folder and those in the user's ontology folders.
    `places` are the files on disk of all these texts, by path. `namespaces` are those of the terms of libraries with
    a `skillc.toml`, by name; `project` is the library's own, None without one. `backend` is where its tasks shall run,
    None for the one that each of them names, or the project.
    """

    name: str
    root: Path
    sources: tuple[Source, ...]
    importable: dict[str, Source]
    places: dict[str, Path]
    vocabularies: tuple[Source, ...]
    namespaces: Mapping[str, str]
    project: Project | None
    backend: str | None = None

    def backend_of(self, task: str | None, default: str | None = None) -> str:
        """Return the back end in whose cells a task runs that names the back end `task`, or none.

        `default` is that of tasks of projects that name none.
        """
        of_project = self.project.manifest.tool.run.backend if self.project else None
        return self.backend or task or of_project or default or DEFAULT_BACKEND

    def is_symbolic(self, task: str | None = None) -> bool:
        """Whether such a task runs in cells without bodies, so that nothing spatial is asked of its scene."""
        return self.backend_of(task) == SYMBOLIC

    def display_path(self, path: str) -> str:
        """Return a source's path as displayed: relative to the current folder, or absolute outside of it."""
        file = str(self.places.get(path) or catalogue.ROOT / path)
        return file.removeprefix(os.path.join(os.getcwd(), ""))  # noqa: PTH109, PTH118 - of each file of a library

    def with_display_paths(self, problem: Diagnostic) -> Diagnostic:
        """Return a diagnostic with paths as they are displayed."""

        def shown(span: Span) -> Span:
            return span._replace(path=self.display_path(span.path))

        return replace(
            problem,
            span=shown(problem.span),
            labels=tuple(label._replace(span=shown(label.span)) for label in problem.labels),
            fix=problem.fix._replace(span=shown(problem.fix.span)) if problem.fix else None,
        )


def find_library(path: Path) -> LibraryFiles:
    """Read the library in the folder `path`, the single file at `path`, or the library of that name.

    A folder in a project stands for the project. A name is that of a library on which the project in the current
    folder depends, or of a shipped one. RequestError for a path that is none of these, cannot be read, or has no
    `.skill` file; DiagnosticsError for a project whose manifest has errors.
    """
    found = inspect_path(path)
    if found.kind == "missing":
        path = _find_by_name(path)
        found = inspect_path(path)
    if found.kind == "unusable":
        raise RequestError(f"{path} {found.is_what}")
    if found.kind == "folder":
        return _read_folder(path)
    if path.suffix != ".skill":
        raise RequestError(f"{path} is not a .skill file")
    return read_single_file(path, read_content(path))


def _find_by_name(name: Path) -> Path:
    """Return the folder of a dependency or of a shipped library; RequestError if there is none of that name."""
    here = find_project(Path())
    libraries = {each.name: each.root for each in (here.others() if here else ())}
    root = libraries.get(str(name), SHIPPED / name)
    if inspect_path(root).kind == "missing":
        from difflib import get_close_matches

        shipped = (each.name for each in SHIPPED.iterdir() if each.is_dir())
        near = get_close_matches(str(name), sorted({*libraries, *shipped}), n=1)
        hint = f"; did you mean the library `{near[0]}`?" if near else ""
        raise RequestError(f"there is no file or folder {name}{hint}")
    return root


def _read_folder(folder: Path) -> LibraryFiles:
    project = find_project(folder)
    root = project.root if project else folder
    files = list_files_below(root)
    sources = {shown: file for shown, file in files.items() if shown.endswith(".skill")}
    if not sources:
        raise RequestError(f"there is no .skill file in {root}")
    texts = tuple(read_source(file, shown) for shown, file in sources.items())
    beside = {shown: file for shown, file in files.items() if is_vocabulary_beside(file, project)}
    name = project.name if project else root.resolve().name
    return _library(Home(name, root, project), texts, sources, {}, beside)


def read_single_file(path: Path | None, content: bytes) -> LibraryFiles:
    """Return a library of one file at `path` (None: no file) with this content, which can import its neighbours."""
    path = path or _STDIN
    others = (file for file in sorted(path.parent.glob("*.skill")) if file.name != path.name and file.is_file())
    neighbours = {file.name: (file.name, file) for file in others}
    source = decode(path.name, content)
    project = find_project(path.parent)
    files = list_files_below(project.root) if project else list_files_in(path.parent)
    beside = {shown: file for shown, file in files.items() if is_vocabulary_beside(file, project)}
    home = Home(project.name if project else path.resolve().parent.name, path.parent, project)
    return _library(home, (source,), {path.name: path}, neighbours, beside)


def read_surroundings(project: Project) -> LibraryFiles:
    """Return the library of a project without its own files: what they may import, and the namespaces."""
    return _library(Home(project.name, project.root, project), (), {}, {}, {})


def source_texts(library: LibraryFiles) -> dict[str, Source]:
    """Return every text of the library and of its possible imports, by displayed path."""
    every = (*library.sources, *library.importable.values(), *library.vocabularies)
    shown = (each._replace(path=library.display_path(each.path)) for each in every)
    return {each.path: each for each in shown}


def find_scene(scene: Path, folders: Sequence[Path] = ()) -> Path:
    """Return a scene file: the path itself, or relative to the project here or to `folders`, or a shipped scene."""
    found = inspect_path(scene)
    if found.kind == "file":
        return scene
    root = projects.find_root(Path())
    if root is not None and inspect_path(root / scene).kind == "file":
        return Path(os.path.relpath(root / scene))
    for each in folders:
        if inspect_path(each / scene).kind == "file":
            return each / scene
    try:
        return catalogue.scene_path(str(scene))
    except FileNotFoundError as error:
        here = " or in ".join(("here", *map(str, folders)))
        missing = f"there is no file {scene} {here}, and {error}"
        raise RequestError(missing if found.kind == "missing" else f"{scene} {found.is_what}") from error


class Home(NamedTuple):
    """The name of a library, its folder, and its project if it has one."""

    name: str
    root: Path
    project: Project | None

    def others(self) -> tuple[Project, ...]:
        """Return the libraries that it depends on."""
        return self.project.others() if self.project else ()


def edition_of(root: Path, project: Project | None) -> int:
    """Return the edition that the library in a folder is written in; shipped ones are of the newest."""
    if project:
        return project.manifest.edition
    there = root.resolve()
    return NEWEST if there == SHIPPED.parent or there.is_relative_to(SHIPPED) else FIRST


def _library(
    home: Home,
    sources: tuple[Source, ...],
    places: Mapping[str, Path],
    neighbours: Mapping[str, tuple[str, Path]],
    beside: Mapping[str, Path],
) -> LibraryFiles:
    if home.project:
        use_ontologies(home.project)
    if not home.root.is_relative_to(SHIPPED):
        use_modules((home.root, *(each.root for each in home.others())))
    of_dependencies, edition = _of_dependencies(home.others()), edition_of(home.root, home.project)
    importable = {**_shipped(), **of_dependencies, **neighbours}
    editions = {each.name: each.manifest.edition for each in home.others()}
    written_in = {wanted: editions[wanted.partition("/")[0]] for wanted in of_dependencies}
    written_in |= dict.fromkeys(neighbours, edition)
    texts = {
        wanted: read_source(file, shown)._replace(edition=written_in.get(wanted, NEWEST))
        for wanted, (shown, file) in sorted(importable.items())
    }
    own = tuple(each._replace(edition=edition) for each in sources)
    stated = {**user_vocabularies(), **_vocabularies_of(home.others()), **beside}
    vocabularies = follow_imports(stated, imports_of(home))
    read = read_vocabularies(sorted(vocabularies.items()))
    located = {**vocabularies, **dict(importable.values()), **places}
    namespaces = {each.name: each.namespace for each in (*home.others(), *([home.project] if home.project else []))}
    return LibraryFiles(home.name, home.root, own, texts, located, read, namespaces, home.project)


def imports_of(home: Home) -> dict[str, Path]:
    """Return the files that a project and those on which it depends name for imported ontologies; its own count."""
    every = (*home.others(), *([home.project] if home.project else []))
    return {iri: each.root / path for each in every for iri, path in each.manifest.imports.items()}


def use_ontologies(project: Project) -> None:
    """Add the ontology folders of a project and of what it depends on, in this context and in processes it starts."""
    known = set(map(Path.resolve, catalogue.user_folders()))
    folders = [folder for each in (project, *project.others()) for folder in each.ontologies if folder.is_dir()]
    catalogue.add_folders(each for each in dict.fromkeys(map(Path.resolve, folders)) if each not in known)


def use_modules(folders: Iterable[Path]) -> None:
    """Let Python import what stands in the folders of a library and of what it depends on, after all that is installed.

    Processes that it starts inherit that. A command restores the path of Python when it ends.
    """
    roots = [str(each.resolve()) for each in folders]
    sys.path.extend(root for root in dict.fromkeys(roots) if root not in sys.path)


def _of_dependencies(others: Iterable[Project]) -> dict[str, tuple[str, Path]]:
    """Return the skill files of other libraries by the name that imports them, with their displayed paths."""
    every = ((f"{each.name}/{shown}", file) for each in others for shown, file in list_files_below(each.root).items())
    return {shown: (shown, file) for shown, file in every if shown.endswith(".skill")}


def _vocabularies_of(others: Iterable[Project]) -> dict[str, Path]:
    """Return the vocabularies beside the skill files of other libraries, by displayed path."""
    return {
        f"{each.name}/{shown}": file
        for each in others
        for shown, file in list_files_below(each.root).items()
        if is_vocabulary_beside(file, each)
    }


def _shipped() -> dict[str, tuple[str, Path]]:
    """Return the shipped files by the name that imports them, with their displayed paths."""
    files = sorted(SHIPPED.glob("*/*.skill"))
    named = ((file, f"{file.parent.name}/{file.name}") for file in files)
    return {file.name if file.parent.name == "std" else shown: (shown, file) for file, shown in named}
