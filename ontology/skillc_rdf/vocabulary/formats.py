"""Detects the format of an ontology by its first lines, because tools use different file endings."""

from __future__ import annotations

import re
from typing import NamedTuple, TypeAlias

import pyoxigraph as ox

from skillc_dsl.source import Source


class UnsupportedFormat(NamedTuple):
    """A format that is not supported, and what to do about it."""

    name: str
    help: str


Format: TypeAlias = ox.RdfFormat | UnsupportedFormat

BY_ENDING = {".trig": ox.RdfFormat.TRIG, ".nq": ox.RdfFormat.N_QUADS, ".jsonld": ox.RdfFormat.JSON_LD}
PROTEGE = "save it as Turtle or RDF/XML; Protégé and ROBOT do"
_COMMENTS = r"(?:\s|#[^\n]*\n)*"
_PROLOGUE = r"\s*(?:<\?xml[^>]*\?>|<!--.*?-->|<!DOCTYPE[^\[>]*(?:\[.*?\]\s*)?>|\s)*"
_FORMATS: tuple[tuple[re.Pattern[str], Format], ...] = (
    (re.compile(rf"{_PROLOGUE}<Ontology\b", re.DOTALL), UnsupportedFormat("OWL/XML", PROTEGE)),
    (
        re.compile(rf"{_PROLOGUE}<(?:html|head|body)\b", re.DOTALL | re.I),
        UnsupportedFormat("HTML", "download the file itself"),
    ),
    (re.compile(rf"{_COMMENTS}(?:Prefix|Ontology)\s*\("), UnsupportedFormat("OWL's functional syntax", PROTEGE)),
    (re.compile(rf"{_COMMENTS}(?:Prefix|Ontology):\s"), UnsupportedFormat("Manchester syntax", PROTEGE)),
    (re.compile(r"\s*(?:<\?xml|<!DOCTYPE|<!--|<rdf:RDF|<[\w-]+:[\w-]+[\s>])"), ox.RdfFormat.RDF_XML),
    (re.compile(r'\s*(?:\{\s*["}]|\[\s*\{)'), ox.RdfFormat.JSON_LD),
)


def detect_format(source: Source) -> Format:
    """Return the format of a text; the default is Turtle, which includes N-Triples."""
    for pattern, found in _FORMATS:
        if pattern.match(source.text):
            return found
    return next((found for ending, found in BY_ENDING.items() if source.path.endswith(ending)), ox.RdfFormat.TURTLE)
