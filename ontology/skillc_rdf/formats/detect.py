"""Detects the format of an RDF text by its content, because tools use different file endings."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import NamedTuple, TypeAlias

import pyoxigraph as ox

from skillc_dsl.source import Source
from skillc_rdf.formats.owl_syntax import OwlSyntax


class UnsupportedFormat(NamedTuple):
    """A format that is not supported, and what to do about it."""

    name: str
    help: str


Format: TypeAlias = ox.RdfFormat | OwlSyntax | UnsupportedFormat

CACHED = 64
"""The number of texts whose format is cached."""
_BY_ENDING = {".trig": ox.RdfFormat.TRIG, ".nq": ox.RdfFormat.N_QUADS, ".jsonld": ox.RdfFormat.JSON_LD}
_COMMENTS = r"(?:\s|#[^\n]*\n)*+"
_PROLOGUE = r"(?>\s+|<\?.*?\?>|<!--.*?-->|<!DOCTYPE[^\[>]*(?:\[.*?\]\s*)?>)*+"
"""What may stand before the first element; no part is read in two ways, so that the time is linear."""
_FORMATS: tuple[tuple[re.Pattern[str], Format], ...] = (
    (re.compile(rf"{_PROLOGUE}<Ontology\b", re.DOTALL), OwlSyntax("OWL/XML", "owx")),
    (
        re.compile(rf"{_PROLOGUE}<(?:html|head|body)\b|\s*<!DOCTYPE\s+html\b", re.DOTALL | re.I),
        UnsupportedFormat("HTML", "download the file itself"),
    ),
    (re.compile(rf"{_COMMENTS}(?:Prefix|Ontology)\s*\("), OwlSyntax("OWL's functional syntax", "ofn")),
    (re.compile(rf"{_COMMENTS}(?:Prefix|Ontology):\s"), OwlSyntax("Manchester syntax", "omn")),
    (re.compile(r"\s*(?:<\?xml|<!DOCTYPE|<!ENTITY|<!--|<rdf:RDF|<[\w-]+:[\w-]+\s[^>]*xmlns)"), ox.RdfFormat.RDF_XML),
    (re.compile(r'\s*(?:\{\s*["}]|\[\s*[{\]])'), ox.RdfFormat.JSON_LD),
)
_GRAPH = re.compile(r"(?:^|[\s.}>])\{")
_NODE = r"(?:<[^>\n]*>|_:[^\s<>\"]+)"
_LITERAL = r"\"(?:[^\"\\\n]|\\.)*+\"(?:@[\w-]+|\^\^<[^>\n]*>)?"
_LINES = re.compile(rf"{_COMMENTS}{_NODE}\s")
_QUAD = re.compile(
    rf"^[ \t]*+{_NODE}[ \t]*+<[^>\n]*>[ \t]*+(?:{_NODE}|{_LITERAL})[ \t]*+{_NODE}[ \t]*+\.", re.MULTILINE
)


@lru_cache(maxsize=CACHED)
def detect_format(source: Source) -> Format:
    """Return the format of a text; the default is Turtle, which includes N-Triples."""
    for pattern, found in _FORMATS:
        if pattern.match(source.text):
            return found
    path = source.path.removesuffix(".gz")
    by_ending = next((found for ending, found in _BY_ENDING.items() if path.endswith(ending)), None)
    return by_ending or _with_graphs(source.text) or ox.RdfFormat.TURTLE


def _with_graphs(text: str) -> ox.RdfFormat | None:
    """Return the format of a text with named graphs, None if it has none or is not valid."""
    if _LINES.match(text) and _QUAD.search(text) and _has_graphs(text, ox.RdfFormat.N_QUADS):
        return ox.RdfFormat.N_QUADS
    is_trig = "{" in text and _GRAPH.search(text) and _has_graphs(text, ox.RdfFormat.TRIG)
    return ox.RdfFormat.TRIG if is_trig else None


def _has_graphs(text: str, form: ox.RdfFormat) -> bool:
    """Whether a text is valid and names graphs; braces may also be in a literal or a comment."""
    try:
        graphs = [each.graph_name for each in ox.parse(text, form, base_iri="file:///x")]
    except (SyntaxError, ValueError, MemoryError):
        return False
    return any(not isinstance(each, ox.DefaultGraph) for each in graphs)
