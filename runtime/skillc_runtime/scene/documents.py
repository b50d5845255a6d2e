"""Reads RDF files as statements with their positions; SceneError is the error for a scene with mistakes."""

from __future__ import annotations

import errno
from collections.abc import Iterable, Mapping
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec
import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.encoding import is_packed, unpack
from skillc_dsl.source import Source, Span
from skillc_rdf.formats.detect import detect_format
from skillc_rdf.turtle.statements import Parsed, Statement
from skillc_rdf.turtle.terms import OWL, RDF, RDFS, XSD
from skillc_runtime.scene.memory import BULK_BYTES, TooLittleMemory, check_available

if TYPE_CHECKING:
    from skillc_runtime.scene.conversion import Origin

BASE = "file:///scene"
WELL_KNOWN = (
    ("owl", OWL),
    ("rdf", RDF),
    ("rdfs", RDFS),
    ("xsd", XSD),
)
CACHED, SMALL_CHARACTERS = 128, 64_000
"""The number of parsed small files that are kept: all packaged ones, with and without the prefixes of vocabularies."""
LARGE_CACHED = 4
"""The number of parsed files that are larger."""


class SceneError(ValueError):
    """A scene that cannot be loaded, with all problems."""

    def __init__(self, problems: Iterable[Diagnostic]) -> None:
        self.problems = tuple(sorted(problems, key=lambda each: (each.span, each.name, each.message)))
        super().__init__("\n".join(map(str, self.problems)))


class Document(msgspec.Struct, frozen=True):
    """A text in Turtle: its path or name in messages, and where it comes from if that was in another format.

    `truth` is what is true there, but not known.
    """

    path: str
    text: str
    origin: Origin | None = None
    truth: Document | None = None

    @staticmethod
    def of(path: str, text: str) -> Document:
        """Return a text in any format as a document; SceneError when it cannot be read."""
        source = Source(path, text)
        form = detect_format(source)
        if form == ox.RdfFormat.TURTLE:
            return Document(path, text)
        from skillc_rdf.formats.read import UnreadableError, read_content
        from skillc_runtime.scene.conversion import convert

        try:
            content = read_content(source, BASE)
            hidden = msgspec.structs.replace(content, triples=content.truth)
            truth = Document(path, *convert(source, hidden)) if content.truth else None
            return Document(path, *convert(source, content), truth)
        except UnreadableError as error:
            place = Span(path, error.line, error.column, error.line, error.column + 1)
            raise SceneError([Diagnostic("unreadable-scene", place, str(error), error.help)]) from error

    @staticmethod
    def read(path: Path) -> Document:
        """Read a file; SceneError when it cannot be read, is not UTF-8, or is too large for the available memory."""
        try:
            check_available(BULK_BYTES * path.stat().st_size)
            if not path.is_file():
                raise OSError(errno.EINVAL, "it is not a regular file")
            data = path.read_bytes()
            if is_packed(data):
                data = unpack(data)
                check_available(BULK_BYTES * len(data))
            text = data.decode("utf-8-sig")
        except OSError as error:
            raise SceneError([unreadable_problem(str(path), error.strerror or str(error))]) from error
        except TooLittleMemory as error:
            raise SceneError([unreadable_problem(str(path), str(error))]) from error
        except UnicodeDecodeError as error:
            raise SceneError([_not_utf8(path, data, error.start)]) from error
        if "\0" in text[:2]:
            raise SceneError([_not_utf8(path, data, 0)])
        return Document.of(str(path), text)


def parse(document: Document, prefixes: Mapping[str, str] | None = None) -> Parsed:
    """Parse a document, with all syntax problems; `prefixes` are those of the vocabularies."""
    parsed = _small if len(document.text) <= SMALL_CHARACTERS else _large
    return parsed(document, (*WELL_KNOWN, *sorted((prefixes or {}).items())))


def statements_of(document: Document) -> tuple[Statement, ...]:
    """Return the statements of a document; SceneError when it is not Turtle."""
    parsed = parse(document)
    if parsed.problems:
        raise SceneError(parsed.problems)
    return parsed.statements


def with_canonical_terms(statement: Statement, aliases: Mapping[str, str]) -> Statement:
    """Return the statement with aliases of terms replaced by the terms."""
    if statement.predicate in aliases:
        statement = statement._replace(predicate=aliases[statement.predicate])
    if isinstance(statement.object, ox.NamedNode) and statement.object.value in aliases:
        return statement._replace(object=ox.NamedNode(aliases[statement.object.value]))
    return statement


def unreadable_problem(path: str, reason: str, line: int = 1, column: int = 1) -> Diagnostic:
    """Return the problem of a file that cannot be read."""
    place = Span(path, line, column, line, column + 1)
    return Diagnostic(
        "unreadable-scene", place, f"cannot read {path}: {reason}", "save it as UTF-8" * ("UTF" in reason)
    )


def _parsed(document: Document, prefixes: tuple[tuple[str, str], ...]) -> Parsed:
    # Files are read in bulk, without positions, unless something in them is wrong.
    from skillc_rdf.turtle.parser import parse as parse_turtle

    parsed = parse_turtle(document.path, document.text, BASE, dict(prefixes))
    if document.origin is None:
        return parsed
    from skillc_runtime.scene.conversion import lead_back

    return lead_back(parsed, document.text, document.origin, BASE)


_small, _large = lru_cache(maxsize=CACHED)(_parsed), lru_cache(maxsize=LARGE_CACHED)(_parsed)


def _not_utf8(path: Path, data: bytes, start: int) -> Diagnostic:
    """Return the problem of a file at its first byte that is not UTF-8."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff") or b"\0" in data[:2]:
        return unreadable_problem(str(path), "it is UTF-16 or UTF-32, not UTF-8")
    start += 3 * data.startswith(b"\xef\xbb\xbf")
    before = data[:start].decode("utf-8-sig", "replace")
    line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
    return unreadable_problem(str(path), "it is not UTF-8 text", line, column)
