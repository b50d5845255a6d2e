"""The texts of a library that is served: what may be read, what may be changed, and nothing else on the disk."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

from skillc.contract.source import SourceText
from skillc.errors import DiagnosticsError, ServiceError
from skillc.server.library_stamp import list_files
from skillc.server.served_library import ServedLibrary
from skillc.services.library.files import SHIPPED
from skillc.services.project.loading import find_project
from skillc.services.project.project import Project
from skillc.services.reporting.files import rewrite_file
from skillc_dsl.encoding import MOST_BYTES, decode, normalise_newlines, read_file

TEXTS = (".skill", ".ttl")


class SourceChanged(ServiceError):
    """The file has another content than a change is based on."""


class NotEditable(ServiceError):
    """The file may not be changed here."""


@dataclass(frozen=True, slots=True)
class SourceFile:
    """Where a text is."""

    file: Path
    editable: bool


def list_sources(library: ServedLibrary) -> dict[str, SourceFile]:
    """Return the files of a library, and those that it may import, by path.

    Links that lead out of a library's folder are not followed. The path of a request is looked up here, and nothing
    else is opened.
    """
    shipped = {f"{file.parent.name}/{file.name}": file for file in sorted(SHIPPED.glob("*/*.skill"))}
    imported = {path: SourceFile(file, False) for path, file in (*shipped.items(), *_list_imported(library))}
    root = Path(library.checked.basis.folders[0])
    editable = not root.is_relative_to(SHIPPED.resolve())
    own = _list_below(root) if Path(library.path).is_dir() else _list_beside(root)
    return imported | {path: SourceFile(file, editable) for path, file in own}


def read_source(sources: Mapping[str, SourceFile], path: str) -> SourceText:
    """Return a text; ServiceError if it is not there, or cannot be read."""
    found = _find(sources, path)
    content = _read(found, path)
    return SourceText(path, found.editable, _hash(content), decode(path, content).text)


def write_source(sources: Mapping[str, SourceFile], path: str, text: str, base_hash: str) -> SourceText:
    """Change a text, completely or not at all; line ends and byte order mark stay. Return what it is then.

    SourceChanged if the file is no longer the one with `base_hash`, NotEditable if it may not be changed, ServiceError
    if it is not there or cannot be written; then it is not changed.
    """
    found = _find(sources, path)
    if not found.editable:
        raise NotEditable(f"{path} is not of this library; copy it to change it")
    content = _read(found, path)
    if _hash(content) != base_hash:
        raise SourceChanged(f"{path} was changed by somebody else; read it again, and make the change there")
    before = decode(path, content)
    if before.unreadable:
        raise NotEditable(f"{path} is not encoded as UTF-8; change it with another program")
    rewrite_file(found.file, before.text, normalise_newlines(text))
    return read_source(sources, path)


def _list_imported(library: ServedLibrary) -> Iterator[tuple[str, Path]]:
    """Yield the texts of the libraries that a library depends on."""
    for project in _find_dependencies(Path(library.path)):
        yield from ((f"{project.name}/{path}", file) for path, file in _list_below(project.root.resolve()))


def _find_dependencies(path: Path) -> tuple[Project, ...]:
    try:
        project = find_project(path if path.is_dir() else path.parent)
    except (DiagnosticsError, ServiceError):
        return ()  # the manifest has errors; those of the library say so
    return project.others() if project is not None else ()


def _list_below(root: Path) -> Iterator[tuple[str, Path]]:
    for file in list_files(root, TEXTS):
        if file.resolve().is_relative_to(root) and file.is_file():
            yield file.relative_to(root).as_posix(), file


def _list_beside(root: Path) -> Iterator[tuple[str, Path]]:
    """Yield the texts in a folder of which only one file is served: what is below it is not of the library."""
    for path, file in ((each.name, each) for each in sorted(root.iterdir()) if each.suffix in TEXTS):
        if file.resolve().parent == root and file.is_file():
            yield path, file


def _find(sources: Mapping[str, SourceFile], path: str) -> SourceFile:
    if path not in sources:
        raise ServiceError(f"the library has no text `{path}`")
    return sources[path]


def _read(source: SourceFile, path: str) -> bytes:
    try:
        return read_file(source.file, MOST_BYTES)
    except OSError as error:
        raise ServiceError(f"{path} cannot be read: {error.strerror or error}") from error


def _hash(content: bytes) -> str:
    return sha256(content).hexdigest()
