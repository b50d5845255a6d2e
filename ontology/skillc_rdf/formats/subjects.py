"""Finds where a text that is not Turtle is about something: parsers of these formats keep no positions."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from urllib.parse import urljoin
from xml.parsers import expat

import pyoxigraph as ox

from skillc_dsl.source import Source, Span
from skillc_rdf.formats import json_ld
from skillc_rdf.formats.detect import Format, detect_format
from skillc_rdf.turtle.terms import RDF

_XML_BASE = "http://www.w3.org/XML/1998/namespace base"


class SubjectFinder:
    """The spans of subjects in a text; `prefixes` are those that it declares."""

    def __init__(self, source: Source, prefixes: Mapping[str, str], base: str = "") -> None:
        self._source, self._prefixes, self._base = source, prefixes, base
        self._form: Format = detect_format(source)
        self._elements: dict[str, Span] | None = None
        self._names: dict[str, tuple[int, int]] | None = None

    def find(self, iri: str) -> Span | None:
        """Return where a text is about an IRI first, None if it is not written there in a known form."""
        match self._form:
            case ox.RdfFormat.RDF_XML:
                if self._elements is None:
                    self._elements = dict(reversed(list(find_elements(self._source))))
                return self._elements.get(iri) or self._elements.get(iri.removeprefix(self._base))
            case ox.RdfFormat.JSON_LD:
                return self._in_json(iri)
            case _:
                return self._in_text(iri)

    def _in_json(self, iri: str) -> Span | None:
        if self._names is None:
            self._names = json_ld.find_names(self._source.text)
        found = (self._names[each] for each in self._forms(iri) if each in self._names)
        first = next(found, None)
        return self._span(*first) if first else None

    def _in_text(self, iri: str) -> Span | None:
        forms = [f"<{re.escape(iri)}>", *(rf"(?<![\w.-]){re.escape(each)}(?![\w-])" for each in self._forms(iri)[1:])]
        match = re.search("|".join(forms), self._source.text)
        return self._span(*match.span()) if match else None

    def _forms(self, iri: str) -> list[str]:
        short = (f"{name}:{iri[len(base) :]}" for name, base in self._prefixes.items() if iri.startswith(base))
        own = [iri.removeprefix(self._base)] if self._base and iri.startswith(self._base) else []
        return [iri, *short, *own]

    def _span(self, start: int, end: int) -> Span:
        text = self._source.text
        line, column = text.count("\n", 0, start) + 1, start - text.rfind("\n", 0, start)
        return Span(self._source.path, line, column, line, column + end - start)


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
