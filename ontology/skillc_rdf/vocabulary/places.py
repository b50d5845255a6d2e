"""Finds where ontologies declare terms and state axioms: lines in every format, columns in Turtle."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cached_property

import pyoxigraph as ox

from skillc_dsl.position import Position
from skillc_dsl.source import Source, Span
from skillc_rdf.formats.detect import detect_format
from skillc_rdf.formats.subjects import find_elements
from skillc_rdf.turtle.parser import parse
from skillc_rdf.turtle.statements import Statement
from skillc_rdf.vocabulary.positions import find_subjects
from skillc_rdf.vocabulary.types import local_name

_IRI = re.compile(r"[^\s<>\"'{}|^`\\]+")
_WORD = re.compile(r"[\w%-]+(?:\.[\w%-]+)*")


class TermPositions:
    """The positions of terms and statements, computed lazily."""

    def __init__(self, sources: Iterable[Source]) -> None:
        self._sources = tuple(sources)
        self._turtle = tuple(each for each in self._sources if detect_format(each) == ox.RdfFormat.TURTLE)

    @cached_property
    def terms(self) -> dict[str, Position]:
        """Where each IRI is declared, or is a subject for the first time."""
        found: dict[str, Position] = {}
        for source in self._sources:
            if detect_format(source) == ox.RdfFormat.RDF_XML:
                elements = reversed(list(find_elements(source)))
                found = {iri: Position(at.path, at.line, at.column) for iri, at in elements} | found
        return {**found, **find_subjects(self._turtle)}

    def position(self, iri: str) -> Position:
        """Return where a term is declared, else where it is mentioned."""
        if iri in self.terms:
            return self.terms[iri]
        span = self._mentions.get(iri) or self._found(iri)
        return Position(span.path, span.line, span.column)

    def term(self, iri: str) -> Span:
        """Return where a term is declared, else where it is mentioned, as a span."""
        place = self.position(iri)
        return Span(place.path, place.line, place.column, place.line, place.column + 1)

    def statement(self, subject: str, predicate: str, object_: str | None = None) -> Span:
        """Return the span of the object in a statement, or of `subject` if there is no such statement in Turtle."""
        for each in self._said.get(subject, ()):
            if each.predicate == predicate and object_ in (None, _iri(each.object)):
                place = each.object_place
                return Span(place.path, place.line, place.column, place.end_line, place.end_column)
        return self.term(subject)

    def unnamed_objects(self, subject: str, predicate: str) -> list[Span]:
        """Return where a predicate has objects without a name in Turtle, or all objects if `subject`, "", has none."""
        said = (each for each in self._said.get(subject, ()) if each.predicate == predicate)
        places = (each.object_place for each in said if not subject or not _iri(each.object))
        return [Span(each.path, each.line, each.column, each.end_line, each.end_column) for each in places]

    @cached_property
    def _said(self) -> dict[str, list[Statement]]:
        said: dict[str, list[Statement]] = {}
        for source in self._turtle:
            for each in parse(source.path, source.text, base="file:///x").statements:
                said.setdefault(_iri(each.subject), []).append(each)
        return said

    @cached_property
    def _mentions(self) -> dict[str, Span]:
        """Where each IRI is an object in Turtle for the first time."""
        found: dict[str, Span] = {}
        for statements in self._said.values():
            for each in statements:
                place = each.object_place
                span = Span(place.path, place.line, place.column, place.end_line, place.end_column)
                iri = _iri(each.object)
                found[iri] = min(found.get(iri, span), span)
        return found

    def _found(self, iri: str) -> Span:
        """Return the first line that contains the IRI, or else its local name; by default the first line of all."""
        default = Span(self._sources[0].path if self._sources else iri, 1, 1, 1, 2)
        return self._lines.get(iri) or self._lines.get(local_name(iri), default)

    @cached_property
    def _lines(self) -> dict[str, Span]:
        """The first line of each IRI and each word of the sources."""
        found: dict[str, Span] = {}
        for source in self._sources:
            for number, line in enumerate(source.text.split("\n"), start=1):
                span = Span(source.path, number, 1, number, 2)
                for written in (*_IRI.findall(line), *_WORD.findall(line)):
                    found.setdefault(written, span)
        return found


def _iri(node: object) -> str:
    return node.value if isinstance(node, ox.NamedNode) else ""
