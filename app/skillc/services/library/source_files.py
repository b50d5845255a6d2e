"""Reads the files of libraries: skills and vocabularies in folders."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from pathlib import Path
from typing import NoReturn

from skillc.errors import RequestError
from skillc.services.project import project as projects
from skillc.services.project.project import Project
from skillc.services.reporting.files import inspect_path
from skillc_compiler.emit.headers import is_generated
from skillc_dsl.encoding import MOST_BYTES, decode, read_file, unpack
from skillc_dsl.source import Source
from skillc_ontology import catalogue

_IN_TURTLE = re.compile(
    r"^(?:<[^>\n]*>|[^#<\n])*?(?:owl:Ontology\b|<[^>\n]*owl#Ontology>)|^\s*Ontology\s*[:(]\s*<", re.MULTILINE
)

_NOT_TURTLE = ("<?xml", "<!", "<rdf:", "{", "[")

_ELSEWHERE = re.compile(r"(?:owl:|owl#|&owl;)Ontology[\"\s/>]|\bontologyIRI=")


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
    """Whether a file is a vocabulary: it declares an owl:Ontology, which scenes do not, and skillc did not write it.

    In functional and Manchester syntax, and in OWL/XML, a vocabulary is an ontology with a name.
    """
    if not path.name.endswith(catalogue.ENDINGS):
        return False
    try:
        content = read_file(path)
    except OSError:
        return False
    try:
        text = unpack(content).decode("utf-8", errors="replace")
    except OSError:
        return True  # who reads it says what is wrong
    written = _ELSEWHERE if text.lstrip("\ufeff \t\r\n").startswith(_NOT_TURTLE) else _IN_TURTLE
    return bool(written.search(text)) and not is_generated(text)


def read_vocabularies(files: Iterable[tuple[str, Path]]) -> tuple[Source, ...]:
    """Read files; RequestError for one that cannot be read."""
    return tuple(decode(shown, read_content(path, most=-1)) for shown, path in files)


def is_vocabulary_beside(file: Path, project: Project | None) -> bool:
    """Whether a file is a vocabulary that is not in an ontology folder of the project, whose files are read anyway."""
    folders = project.ontologies if project else ()
    return is_vocabulary(file) and not any(file.is_relative_to(folder) for folder in folders)


def list_files_below(folder: Path) -> dict[str, Path]:
    """Return the files below a folder, in order, by their paths from there.

    Hidden folders, links, other projects and virtual environments below it are not entered.
    """
    found: dict[str, Path] = {}
    for name, folders, names in os.walk(folder, onerror=refuse_unreadable):
        place = Path(name)
        visible = (each for each in folders if not each.startswith("."))
        folders[:] = [each for each in visible if not projects.is_nested_project(place / each)]
        above = "" if place == folder else f"{place.relative_to(folder).as_posix()}/"
        found |= {f"{above}{each}": place / each for each in names}
    return dict(sorted(found.items(), key=lambda item: item[0].split("/")))


def list_files_in(folder: Path) -> dict[str, Path]:
    """Return what is in a folder, in order, by name."""
    return {file.name: file for file in sorted(folder.glob("*"))}


def refuse_unreadable(error: OSError) -> NoReturn:
    """Raise RequestError for a folder that cannot be read."""
    raise RequestError(f"{error.filename} cannot be read: {error.strerror}") from error


def read_source(file: Path, name: str) -> Source:
    """Read a text, which diagnostics call `name`; RequestError if it cannot be read."""
    return decode(name, read_content(file))


def read_content(file: Path, most: int = MOST_BYTES) -> bytes:
    """Read a file of at most so many bytes, -1 for any, uncompressed; RequestError if it cannot be read."""
    try:
        return unpack(read_file(file, most))
    except OSError as error:
        raise RequestError(f"{file} cannot be read: {error.strerror}") from error
