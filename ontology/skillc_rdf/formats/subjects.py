"""Finds where a text that is not Turtle is about something: parsers of these formats keep no positions."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cached_property
from urllib.parse import urljoin
from xml.parsers import expat

import pyoxigraph as ox

from skillc_dsl.source import Source, Span
from skillc_rdf.formats import json_ld
from skillc_rdf.formats.detect import detect_format
from skillc_rdf.formats.owl_syntax import OwlSyntax
from skillc_rdf.turtle.lines import Lines
from skillc_rdf.turtle.terms import RDF

_TERM = re.compile(r"<(?P<iri>[^<>\s]*)>|(?<![\w.-])(?P<name>[\w.-]*:[\w:.%-]*)")
_OWL_TERM = re.compile(
    rf"{_TERM.pattern}|\bIRI=\"(?P<relative>[^\"]*)\"|^\s*(?:Class|Individual|Datatype|\w+Property):\s+(?P<own>[\w.-]+)\s*$",
    re.MULTILINE,
)
"""What names something in the syntaxes of OWL; frames of Manchester syntax leave the empty prefix out."""
_XML_BASE = "http://www.w3.org/XML/1998/namespace base"


class SubjectFinder:
    """The spans of subjects in a text; `prefixes` are those that it declares."""

    def __init__(self, source: Source, prefixes: Mapping[str, str], base: str = "") -> None:
        self._source, self._prefixes, self._base = source, prefixes, base

    def find(self, iri: str) -> Span | None:
        """Return where a text is about an IRI first, None if it is not written there in a known form."""
        return self._spans.get(iri) or self._spans.get(iri.removeprefix(self._base))

    @cached_property
    def _spans(self) -> dict[str, Span]:
        """Where each IRI, or the relative one that stands for it, is written for the first time."""
        found: dict[str, Span] = {}
        for iri, span in self._written():
            found.setdefault(iri, span)
        return found

    def _written(self) -> Iterator[tuple[str, Span]]:
        text, lines = self._source.text, Lines(self._source.path, self._source.text)
        match detect_format(self._source):
            case ox.RdfFormat.RDF_XML:
                yield from find_elements(self._source)
            case ox.RdfFormat.JSON_LD:
                for name, place in json_ld.find_names(text).items():
                    yield self._expanded(name), lines.place(*place)
            case OwlSyntax():
                for term in _OWL_TERM.finditer(text):
                    named = term["relative"] or term["iri"] or self._expanded(term["name"] or f":{term['own']}")
                    yield urljoin(self._base, named), lines.place(*term.span(term.lastgroup or 0))
            case _:
                for term in _TERM.finditer(text):
                    iri = term["iri"] if term["name"] is None else self._expanded(term["name"].rstrip("."))
                    yield iri, lines.place(*term.span())

    def _expanded(self, name: str) -> str:
        prefix, colon, local = name.partition(":")
        return self._prefixes[prefix] + local if colon and prefix in self._prefixes else name


def find_elements(source: Source) -> Iterator[tuple[str, Span]]:
    """Yield the IRIs and positions of the elements of RDF/XML about an IRI, in order."""
    found: list[tuple[str, Span]] = []
    bases: list[str] = []
    parser = expat.ParserCreate(namespace_separator=" ")

    def start(name: str, attributes: dict[str, str]) -> None:
        bases.append(attributes.get(_XML_BASE, bases[-1] if bases else ""))
        named = attributes.get(f"{RDF} about")
        if f"{RDF} ID" in attributes:
            named = f"#{attributes[f'{RDF} ID']}"
        if named is not None:
            line, column = parser.CurrentLineNumber, parser.CurrentColumnNumber + 1
            width = len(name.rpartition(" ")[2]) + 1
            found.append((urljoin(bases[-1], named), Span(source.path, line, column, line, column + width)))

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda _name: bases.pop() and None
    parser.Parse(source.text, True)
    yield from found
