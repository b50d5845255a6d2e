"""Parses the files of ontologies into triples; unreadable files are skipped and reported."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec
import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.encoding import report_not_text, report_wrong_bytes
from skillc_dsl.source import Source, Span
from skillc_rdf.formats.detect import detect_format
from skillc_rdf.formats.read import UnreadableError, read_content


class Ontology(msgspec.Struct, frozen=True):
    """A file with its triples, in order."""

    source: Source
    triples: tuple[ox.Triple, ...]


def read_ontologies(sources: Iterable[Source]) -> Outcome[tuple[Ontology, ...]]:
    """Read files, each on its own: blank nodes of different files are different."""
    found: list[Ontology] = []
    problems: list[Diagnostic] = []
    for source in sources:
        outcome = _read(source)
        problems += outcome.diagnostics
        found += [Ontology(source, outcome.value)] if outcome.ok else []
    return Outcome(tuple(found), tuple(problems))


def _read(source: Source) -> Outcome[tuple[ox.Triple, ...]]:
    problem = report_not_text(source) or report_wrong_bytes(source)
    if problem is not None:
        return Outcome((), (problem,))
    try:
        return Outcome(read_content(source).triples)
    except UnreadableError as error:
        name = "broken-turtle" if detect_format(source) == ox.RdfFormat.TURTLE else "unreadable-vocabulary"
        place = Span(source.path, error.line, error.column, error.line, error.column + 1)
        return Outcome((), (Diagnostic(name, place, str(error), error.help),))
