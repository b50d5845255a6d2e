"""Parses the files of ontologies into triples; unreadable files are skipped and reported."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from urllib.parse import quote
from xml.parsers import expat

import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.encoding import report_not_text, report_wrong_bytes
from skillc_dsl.source import Source, Span
from skillc_rdf.vocabulary.formats import UnsupportedFormat, detect_format


@dataclass(frozen=True, slots=True)
class Ontology:
    """A file with its triples, in order."""

    source: Source
    triples: tuple[ox.Quad, ...]


def read_ontologies(sources: Iterable[Source]) -> Outcome[tuple[Ontology, ...]]:
    """Read files, each on its own: blank nodes of different files are different."""
    found: list[Ontology] = []
    problems: list[Diagnostic] = []
    for source in sources:
        outcome = _read(source)
        problems += outcome.diagnostics
        found += [Ontology(source, outcome.value)] if outcome.ok else []
    return Outcome(tuple(found), tuple(problems))


def _read(source: Source) -> Outcome[tuple[ox.Quad, ...]]:
    problem = report_not_text(source) or report_wrong_bytes(source)
    if problem is not None:
        return Outcome((), (problem,))
    form = detect_format(source)
    if isinstance(form, UnsupportedFormat):
        place = Span(source.path, 1, 1, 1, 2)
        message = f"this file is {form.name}, which is not supported for vocabularies"
        return Outcome((), (Diagnostic("unreadable-vocabulary", place, message, form.help),))
    base = f"file:///{quote(source.path.lstrip('/'))}"
    try:
        if form == ox.RdfFormat.RDF_XML:
            expat.ParserCreate().Parse(source.text, True)  # reports truncated files
        return Outcome(tuple(ox.parse(source.text, form, base_iri=base, rename_blank_nodes=True)))
    except SyntaxError as error:
        return Outcome((), (_broken(source, form, error),))
    except expat.ExpatError as error:
        reason = expat.errors.messages[error.code]
        return Outcome((), (_broken(source, form, SyntaxError(reason, (None, error.lineno, error.offset + 1, None))),))


def _broken(source: Source, form: ox.RdfFormat, error: SyntaxError) -> Diagnostic:
    line, column = error.lineno or 1, error.offset or 1
    place = Span(source.path, line, column, error.end_lineno or line, error.end_offset or column + 1)
    reason = (error.msg or f"not {form.name}").rpartition(": ")[2]
    turtle = form == ox.RdfFormat.TURTLE
    return Diagnostic(
        "broken-turtle" if turtle else "unreadable-vocabulary",
        place,
        f"this file is not {form.name}: {reason}",
        help="correct the file; until then all of it is ignored",
    )
