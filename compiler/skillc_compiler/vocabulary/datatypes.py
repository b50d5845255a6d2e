"""Which type of the language a data property has."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

import pyoxigraph as ox

from skillc_compiler.library.vocabulary import NumberType, PlainType, Position, ValueType, VectorType
from skillc_compiler.vocabulary.graph import Graph
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span

XSD = "http://www.w3.org/2001/XMLSchema#"
OWL = "http://www.w3.org/2002/07/owl#"
RANGE = "http://www.w3.org/2000/01/rdf-schema#range"
SKILLC = "https://w3id.org/skillc/core#"
NUMBERS = frozenset(f"{XSD}{name}" for name in ("double", "float", "decimal"))
PLAIN: dict[str, ValueType] = {
    f"{XSD}string": PlainType("Text"),
    f"{XSD}boolean": PlainType("Bool"),
    f"{XSD}integer": PlainType("Int"),
    f"{XSD}int": PlainType("Int"),
    f"{SKILLC}Pose": PlainType("Pose"),
}


@dataclass(frozen=True, slots=True)
class Typed:
    """A type, and the finite set of its values where there is one."""

    type: ValueType
    values: tuple[str, ...] = ()


def value_type(graph: Graph, iri: str) -> Typed | None:
    """Return a data property's type from its range and `skillc:dimension`; None where the language has none for it."""
    ranges = graph.objects(iri, RANGE)
    if not ranges:
        return Typed(PlainType("Text"))
    if isinstance(ranges[0], ox.BlankNode):
        return _enumerated(graph, ranges[0])
    dimension = graph.text(iri, f"{SKILLC}dimension") or "Number"
    match ranges[0]:
        case ox.NamedNode(value=datatype) if datatype in NUMBERS:
            return Typed(NumberType(dimension))
        case ox.NamedNode(value=datatype) if datatype == f"{SKILLC}Vector":
            return Typed(VectorType(dimension))
        case ox.NamedNode(value=datatype) if datatype in PLAIN:
            return Typed(PLAIN[datatype])
    return None


def value_types_known(graph: Graph, properties: Iterable[str], places: Mapping[str, Position]) -> Iterator[Diagnostic]:
    """Report the data properties that cannot be used because their range is no type of the language."""
    for iri in properties:
        if value_type(graph, iri) is None:
            place = places.get(iri, Position(iri, 1, 1))
            yield Diagnostic(
                "unknown-datatype",
                Span(place.path, place.line, 1, place.line, 2),
                f"the range of {iri} is no datatype that skillc knows, so the property cannot be used",
                help="use xsd:double, integer, string or boolean, skillc:Pose, skillc:Vector or an owl:oneOf of texts",
                severity="warning",
            )


def _enumerated(graph: Graph, node: ox.BlankNode) -> Typed | None:
    lists = graph.objects(node, f"{OWL}oneOf")
    if not lists:
        return None
    return Typed(PlainType("Text"), tuple(m.value for m in graph.members(lists[0]) if isinstance(m, ox.Literal)))
