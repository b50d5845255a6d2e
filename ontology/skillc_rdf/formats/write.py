"""Writes Turtle in other formats, and as an rdflib graph. rdflib is imported only for JSON-LD and for graphs."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING

import pyoxigraph as ox

from skillc_rdf.turtle.terms import RDF_TYPE

if TYPE_CHECKING:
    from rdflib import Graph

_ALLOWED_CONTROLS = "\t\n\r"


class UnwritableError(ValueError):
    """A statement that a format cannot state; the message names it."""


def format_as(form: str, turtle: str) -> str:
    """Return a Turtle text as `turtle`, `rdfxml`, `jsonld`, `ntriples` or `trig`; UnwritableError.

    A text without blank nodes always gives the same result.
    """
    parser = ox.parse(turtle, ox.RdfFormat.TURTLE)
    triples = [each.triple for each in parser]
    prefixes = dict(sorted(parser.prefixes.items()))
    match form:
        case "rdfxml":
            _check_xml(triples)
            return _serialize(triples, ox.RdfFormat.RDF_XML, prefixes)
        case "ntriples":
            return _serialize(triples, ox.RdfFormat.N_TRIPLES, {})
        case "jsonld":
            return _format_json_ld(turtle, prefixes)
        case "turtle" | "trig":
            return turtle  # TriG without named graphs is Turtle
        case _:
            raise ValueError(form)


def make_graph(turtle: str) -> Graph:
    """Return a Turtle text as an rdflib graph with its prefixes."""
    from rdflib import Graph

    return Graph(bind_namespaces="none").parse(data=turtle, format="turtle")


def _serialize(triples: list[ox.Triple], form: ox.RdfFormat, prefixes: Mapping[str, str]) -> str:
    data = ox.serialize(triples, format=form, prefixes=dict(prefixes) or None)
    assert data is not None
    return data.decode()


def _format_json_ld(turtle: str, prefixes: Mapping[str, str]) -> str:
    document = json.loads(make_graph(turtle).serialize(format="json-ld", context=dict(prefixes)))
    nodes = document.pop("@graph", None)
    if nodes is not None:
        document["@graph"] = sorted(nodes, key=lambda node: node.get("@id", ""))
    return json.dumps(document, indent=2, ensure_ascii=False) + "\n"


def _check_xml(triples: list[ox.Triple]) -> None:
    """Report what XML cannot state: control characters, and relations whose IRIs end with no name."""
    for each in triples:
        predicate = each.predicate.value
        if predicate != RDF_TYPE and not (predicate[-1].isalnum() or predicate[-1] in "_-."):
            raise UnwritableError(f"RDF/XML cannot state <{predicate}>: its IRI does not end with a name")
        if isinstance(each.object, ox.Literal) and any(
            c < " " and c not in _ALLOWED_CONTROLS for c in each.object.value
        ):
            raise UnwritableError(f"RDF/XML cannot state <{predicate}> of {each.subject}: it has a control character")
