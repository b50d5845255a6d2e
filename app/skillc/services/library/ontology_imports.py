"""Finds the files of imported ontologies: in a project's table, in catalogues beside what imports them, by their paths.

Nothing is fetched: what is in no file stays missing, and is reported when the ontologies are read.
"""

from __future__ import annotations

import os
import posixpath
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from skillc.services.library.ontology_catalogue import NAME, find_in_catalogue, to_path
from skillc_dsl.encoding import decode, read_file, unpack
from skillc_dsl.source import Source

if TYPE_CHECKING:
    from skillc_rdf.vocabulary.imports import Header


_OF_FILE = re.compile(r"[iI]mports?\b[^<\">]{0,40}[<\">](?:file:|(?!\w+:))")
"""An import of a file, by its path."""


class _Importing(NamedTuple):
    """A file that may import others, its displayed path, and the catalogues that say where these are."""

    shown: str
    file: Path
    catalogues: tuple[Path, ...]


def follow_imports(files: Mapping[str, Path], table: Mapping[str, Path]) -> dict[str, Path]:
    """Return vocabularies, by displayed path, with all that they import; `table` has files by the IRI of an import.

    An ontology that is already among them is not read twice.
    """
    todo = [_Importing(shown, file, _beside(file)) for shown, file in files.items()]
    found = dict(files)
    known = {file.resolve() for file in files.values()}
    names: set[str] | None = None
    while todo:
        current = todo.pop(0)
        for iri, file in _imported(current, table):
            if names is None:
                names = {name for shown, each in found.items() for name in _names(shown, each)}
            if file in known or iri.rstrip("#/") in names:
                continue
            shown = _shown(current, file)
            known.add(file)
            found[shown] = file
            names |= _names(shown, file)
            todo.append(_Importing(shown, file, tuple(dict.fromkeys((*_beside(file), *current.catalogues)))))
    return found


def _beside(file: Path) -> tuple[Path, ...]:
    catalogue = file.parent / NAME
    return (catalogue,) if catalogue.is_file() else ()


def _imported(importing: _Importing, table: Mapping[str, Path]) -> Iterator[tuple[str, Path]]:
    """Yield what a file imports, and where it is; without a table and a catalogue only files import files."""
    source = _read(importing.shown, importing.file)
    if "mport" not in source.text or not (table or importing.catalogues or _OF_FILE.search(source.text)):
        return
    for iri in _header(source, importing.file).imports:
        listed = (find_in_catalogue(each, iri) for each in importing.catalogues)
        file = table.get(iri) or next((each for each in listed if each), None) or to_path(iri)
        if file is not None and file.is_file():
            yield iri, file.resolve()


def _names(shown: str, file: Path) -> frozenset[str]:
    """Return the names of the ontologies in a file."""
    return _header(_read(shown, file), file).names


def _header(source: Source, file: Path) -> Header:
    from skillc_rdf.vocabulary.imports import read_header  # most libraries import nothing

    return read_header(source, file.resolve().as_uri())


def _read(shown: str, file: Path) -> Source:
    """Return the text of a file; empty if it cannot be read, which is reported where its content is needed."""
    try:
        return decode(shown, unpack(read_file(file)))
    except OSError:
        return Source(shown, "")


def _shown(importing: _Importing, file: Path) -> str:
    """Return the displayed path of an imported file: where it is, as seen from the file that imports it."""
    step = os.path.relpath(file, importing.file.resolve().parent)
    return posixpath.normpath(posixpath.join(posixpath.dirname(importing.shown), Path(step).as_posix()))
