"""In which format an ontology is written: told by what it says first, as endings of files differ from tool to tool."""

from __future__ import annotations

import re
from typing import NamedTuple, TypeAlias

import pyoxigraph as ox

from skillc_dsl.source import Source


class Refused(NamedTuple):
    """A format that is not read, by its name, and what to do about it."""

    name: str
    help: str


Format: TypeAlias = ox.RdfFormat | Refused

BY_ENDING = {".trig": ox.RdfFormat.TRIG, ".nq": ox.RdfFormat.N_QUADS, ".jsonld": ox.RdfFormat.JSON_LD}
PROTEGE = "save it as Turtle or RDF/XML; Protégé and ROBOT do"
_COMMENTS = r"(?:\s|#[^\n]*\n)*"
_PROLOGUE = r"\s*(?:<\?xml[^>]*\?>|<!--.*?-->|<!DOCTYPE[^\[>]*(?:\[.*?\]\s*)?>|\s)*"
_FORMATS: tuple[tuple[re.Pattern[str], Format], ...] = (
    (re.compile(rf"{_PROLOGUE}<Ontology\b", re.DOTALL), Refused("OWL/XML", PROTEGE)),
    (re.compile(rf"{_PROLOGUE}<(?:html|head|body)\b", re.DOTALL | re.I), Refused("HTML", "download the file itself")),
    (re.compile(rf"{_COMMENTS}(?:Prefix|Ontology)\s*\("), Refused("OWL's functional syntax", PROTEGE)),
    (re.compile(rf"{_COMMENTS}(?:Prefix|Ontology):\s"), Refused("Manchester syntax", PROTEGE)),
    (re.compile(r"\s*(?:<\?xml|<!DOCTYPE|<!--|<rdf:RDF|<[\w-]+:[\w-]+[\s>])"), ox.RdfFormat.RDF_XML),
    (re.compile(r'\s*(?:\{\s*["}]|\[\s*\{)'), ox.RdfFormat.JSON_LD),
)


def format_of(source: Source) -> Format:
    """Return the format of a text; what is no other is Turtle, which N-Triples are too."""
    for pattern, found in _FORMATS:
        if pattern.match(source.text):
            return found
    return next((found for ending, found in BY_ENDING.items() if source.path.endswith(ending)), ox.RdfFormat.TURTLE)
