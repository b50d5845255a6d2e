"""Which type of the language a data property has."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import pyoxigraph as ox

from skillc_dsl.diagnostics import Diagnostic, did_you_mean
from skillc_dsl.source import Span
from skillc_dsl.units import DIMENSIONS
from skillc_rdf.vocabulary.graph import Graph, Node
from skillc_rdf.vocabulary.names import EQUAL_CLASS, OWL, RANGE, RDFS, SKILLC, XSD
from skillc_rdf.vocabulary.types import (
    Bounds,
    DirectionType,
    NumberType,
    PlainType,
    Position,
    ValueType,
    VectorType,
    local_name,
)

NUMBERS = frozenset(f"{XSD}{name}" for name in ("double", "float", "decimal"))
INTEGERS = frozenset(
    f"{XSD}{name}"
    for name in (
        *("integer", "int", "long", "short", "byte", "nonNegativeInteger", "positiveInteger", "unsignedInt"),
        *("unsignedLong", "unsignedShort", "unsignedByte", "nonPositiveInteger", "negativeInteger"),
    )
)
PLAIN: dict[str, ValueType] = {
    f"{XSD}string": PlainType("Text"),
    f"{XSD}anyURI": PlainType("Text"),
    f"{RDFS}Literal": PlainType("Text"),
    f"{XSD}boolean": PlainType("Bool"),
    **{datatype: PlainType("Int") for datatype in INTEGERS},
    f"{SKILLC}Pose": PlainType("Pose"),
    f"{SKILLC}Direction": DirectionType(),
}
FACETS = {
    f"{XSD}minInclusive": "least",
    f"{XSD}minExclusive": "above",
    f"{XSD}maxInclusive": "greatest",
    f"{XSD}maxExclusive": "below",
    **{f"{SKILLC}{end}": end for end in ("least", "above", "greatest", "below")},
}
"""What restricts numbers in a datatype, or is said of a property, by the names that `Bounds` has for it."""


@dataclass(frozen=True, slots=True)
class Typed:
    """A type, and the finite set of its values or the bounds of its numbers where there are any."""

    type: ValueType
    values: tuple[str, ...] = ()
    bounds: Bounds | None = None


def value_type(graph: Graph, iri: str) -> Typed | None:
    """Return a data property's type from its range, `skillc:dimension` and the bounds that are said of it.

    None where the language has no type for it.
    """
    ranges = graph.objects(iri, RANGE)
    if not ranges:
        return Typed(PlainType("Text"))
    typed = _typed(graph, ranges[0], graph.text(iri, f"{SKILLC}dimension") or "Number")
    return typed and _bounded(typed, graph, [ox.NamedNode(iri)])


def ranges_of(graph: Graph, iri: str) -> tuple[str, ...]:
    """Return the kinds of values that a data property's ranges ask for at once, in words."""
    types = {_word(typed) for each in graph.objects(iri, RANGE) if (typed := _typed(graph, each, "Number"))}
    return tuple(sorted(types))


def value_types_known(graph: Graph, properties: Iterable[str], places: Mapping[str, Position]) -> Iterator[Diagnostic]:
    """Report the data properties whose range or dimension is none of the language."""
    for iri in sorted(properties):
        place = places.get(iri, Position(iri, 1, 1))
        span = Span(place.path, place.line, 1, place.line, 2)
        found = value_type(graph, iri)
        if found is not None:
            yield from _dimension_known(graph, iri, found.type, span)
        else:
            yield Diagnostic(
                "unknown-datatype",
                span,
                f"the range of {iri} is no datatype that skillc knows, so the property cannot be used",
                help="use xsd:double, integer, string or boolean, skillc:Pose, skillc:Vector, skillc:Direction "
                "or an owl:oneOf of texts",
                severity="warning",
            )


def _dimension_known(graph: Graph, iri: str, type_: ValueType, span: Span) -> Iterator[Diagnostic]:
    """Report a dimension that the language does not have, or that stands at values that have none."""
    dimension = graph.text(iri, f"{SKILLC}dimension")
    if dimension is None:
        return
    if not isinstance(type_, NumberType | VectorType):
        message = f"{iri} has a dimension, {dimension}, and its values are no quantities"
        help_ = "use xsd:double or skillc:Vector as its range, or leave `skillc:dimension` out"
        yield Diagnostic("unknown-dimension", span, message, help_)
    elif dimension not in DIMENSIONS:
        help_ = did_you_mean(dimension, DIMENSIONS)
        yield Diagnostic("unknown-dimension", span, f"{iri} is of the dimension {dimension}, which is none", help_)


def _typed(graph: Graph, range_: Node, dimension: str, within: frozenset[Node] = frozenset()) -> Typed | None:
    """Return the type of one range; one with restrictions is that which it restricts, in bounds. None in a circle."""
    if range_ in within:
        return None
    around = within | {range_}
    match range_:
        case ox.BlankNode():
            restricted = graph.objects(range_, f"{OWL}onDatatype")
            if not restricted:
                return _enumerated(graph, range_)
            return _restricted(graph, range_, _typed(graph, restricted[0], dimension, around))
        case ox.NamedNode(value=datatype) if datatype in NUMBERS:
            return Typed(NumberType(dimension))
        case ox.NamedNode(value=datatype) if datatype == f"{SKILLC}Vector":
            return Typed(VectorType(dimension))
        case ox.NamedNode(value=datatype) if datatype in PLAIN:
            return Typed(PLAIN[datatype])
        case ox.NamedNode(value=datatype):
            defined = [each for each in graph.objects(datatype, EQUAL_CLASS) if isinstance(each, ox.BlankNode)]
            return _typed(graph, defined[0], dimension, around) if defined else None
    return None


def _restricted(graph: Graph, node: ox.BlankNode, typed: Typed | None) -> Typed | None:
    """Return what a restriction leaves of a type; lengths and patterns of texts are passed over."""
    facets = (each for head in graph.objects(node, f"{OWL}withRestrictions") for each in graph.members(head))
    return typed and _bounded(typed, graph, facets)


def _bounded(typed: Typed, graph: Graph, saying: Iterable[Node]) -> Typed:
    """Return a type with the bounds that some nodes state."""
    ends = {
        end: number
        for each in saying
        for facet, end in FACETS.items()
        for literal in graph.objects(each, facet)
        if (number := _number(literal)) is not None
    }
    return replace(typed, bounds=Bounds(**ends)) if ends else typed


def _number(node: Node) -> float | None:
    try:
        return float(node.value) if isinstance(node, ox.Literal) else None
    except ValueError:
        return None


def _word(typed: Typed) -> str:
    match typed.type:
        case PlainType(name="Text"):
            return "a text"
        case PlainType(name="Bool"):
            return "true or false"
        case NumberType() | PlainType(name="Int"):
            return "a number"
        case _:
            return f"a {local_name(type(typed.type).__name__)}"


def _enumerated(graph: Graph, node: ox.BlankNode) -> Typed | None:
    lists = graph.objects(node, f"{OWL}oneOf")
    if not lists:
        return None
    return Typed(PlainType("Text"), tuple(m.value for m in graph.members(lists[0]) if isinstance(m, ox.Literal)))
