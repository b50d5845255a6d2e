"""Determines the types of data properties in the skill language."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import msgspec
import pyoxigraph as ox
from msgspec.structs import replace

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.position import Position
from skillc_dsl.source import Span
from skillc_dsl.spelling import did_you_mean
from skillc_dsl.units import DIMENSIONS
from skillc_rdf.vocabulary.graph import Graph, Node
from skillc_rdf.vocabulary.iris import EQUAL_CLASS, OWL, RANGE, RDF, SKILLC, XSD
from skillc_rdf.vocabulary.text_forms import FORMS, FREE
from skillc_rdf.vocabulary.types import (
    LITERAL,
    Bounds,
    DirectionType,
    NumberType,
    PlainType,
    ValueType,
    VectorType,
    local_name,
)

NUMBERS = frozenset({*(f"{XSD}{name}" for name in ("double", "float", "decimal")), f"{OWL}real"})
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
    f"{RDF}langString": PlainType("Text"),
    f"{RDF}PlainLiteral": PlainType("Text"),
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
"""The facets of datatypes and the annotations of properties that bound numbers, with their fields in `Bounds`."""


class PropertyType(msgspec.Struct, frozen=True):
    """A type, with the finite set of its values or the bounds of its numbers if it has any.

    `datatype` is that of texts which are no strings.
    """

    type: ValueType
    values: tuple[str, ...] = ()
    bounds: Bounds | None = None
    datatype: str = ""


def value_type(graph: Graph, iri: str) -> PropertyType | None:
    """Return a data property's type by its range, `skillc:dimension` and bounds; None if the language has none."""
    ranges = graph.objects(iri, RANGE)
    if not ranges:
        return PropertyType(PlainType("Text"), datatype=LITERAL)
    typed = _type_of(graph, ranges[0], graph.text(iri, f"{SKILLC}dimension") or "Number")
    return typed and _with_bounds(typed, graph, [ox.NamedNode(iri)])


def describe_ranges(graph: Graph, iri: str) -> tuple[str, ...]:
    """Return the kinds of values that a data property's ranges require, as text, sorted."""
    types = {_word(typed) for each in graph.objects(iri, RANGE) if (typed := _type_of(graph, each, "Number"))}
    return tuple(sorted(types))


def check_value_types(graph: Graph, properties: Iterable[str], places: Mapping[str, Position]) -> Iterator[Diagnostic]:
    """Report the data properties whose range or dimension the language does not have."""
    for iri in sorted(properties):
        place = places.get(iri, Position(iri, 1, 1))
        span = Span(place.path, place.line, 1, place.line, 2)
        found = value_type(graph, iri)
        if found is not None:
            yield from _check_dimension(graph, iri, found.type, span)
        else:
            yield Diagnostic(
                "unknown-datatype",
                span,
                f"skillc does not support the range of {iri}, so the property cannot be used",
                help="use a datatype of XSD, skillc:Pose, skillc:Vector, skillc:Direction or an owl:oneOf of texts",
                severity="warning",
            )


def _check_dimension(graph: Graph, iri: str, type_: ValueType, span: Span) -> Iterator[Diagnostic]:
    """Report a dimension that the language does not have, or on a property whose values are not quantities."""
    dimension = graph.text(iri, f"{SKILLC}dimension")
    if dimension is None:
        return
    if not isinstance(type_, NumberType | VectorType):
        message = f"{iri} has the dimension {dimension}, but its values are not quantities"
        help_ = "use xsd:double or skillc:Vector as its range, or remove `skillc:dimension`"
        yield Diagnostic("unknown-dimension", span, message, help_)
    elif dimension not in DIMENSIONS:
        help_ = did_you_mean(dimension, DIMENSIONS)
        yield Diagnostic("unknown-dimension", span, f"{iri} has the dimension {dimension}, which does not exist", help_)


def _type_of(graph: Graph, range_: Node, dimension: str, within: frozenset[Node] = frozenset()) -> PropertyType | None:
    """Return the type of one range, for a restricted datatype with bounds; None for a cyclic definition."""
    if range_ in within:
        return None
    around = within | {range_}
    match range_:
        case ox.BlankNode():
            restricted = graph.objects(range_, f"{OWL}onDatatype")
            if not restricted:
                return _union(graph, range_, dimension, around) or _enumeration(graph, range_)
            return _restrict(graph, range_, _type_of(graph, restricted[0], dimension, around))
        case ox.NamedNode(value=datatype) if datatype in NUMBERS:
            return PropertyType(NumberType(dimension))
        case ox.NamedNode(value=datatype) if datatype == f"{SKILLC}Vector":
            return PropertyType(VectorType(dimension))
        case ox.NamedNode(value=datatype) if datatype in PLAIN:
            return PropertyType(PLAIN[datatype])
        case ox.NamedNode(value=datatype) if datatype in FORMS or datatype in FREE or datatype == LITERAL:
            return PropertyType(PlainType("Text"), datatype=datatype)
        case ox.NamedNode(value=datatype):
            defined = [each for each in graph.objects(datatype, EQUAL_CLASS) if isinstance(each, ox.BlankNode)]
            found = _type_of(graph, defined[0], dimension, around) if defined else None
            return found or _union(graph, range_, dimension, around)
    return None


def _union(graph: Graph, range_: Node, dimension: str, within: frozenset[Node]) -> PropertyType | None:
    """Return the type of a union of datatypes: numbers if all are, else texts; None if it is none."""
    members = [each for head in graph.objects(range_, f"{OWL}unionOf") for each in graph.members(head)]
    types = [_type_of(graph, each, dimension, within) for each in members]
    if not types or None in types:
        return None
    numbers = [isinstance(each, PropertyType) and isinstance(each.type, NumberType) for each in types]
    integers = [isinstance(each, PropertyType) and each.type == PlainType("Int") for each in types]
    if all(integers):
        return PropertyType(PlainType("Int"))
    if all(one or other for one, other in zip(numbers, integers, strict=True)):
        return PropertyType(NumberType(dimension))
    return PropertyType(PlainType("Text"), datatype=LITERAL)


def _restrict(graph: Graph, node: ox.BlankNode, typed: PropertyType | None) -> PropertyType | None:
    """Return a restricted type; lengths and patterns of texts are ignored."""
    facets = (each for head in graph.objects(node, f"{OWL}withRestrictions") for each in graph.members(head))
    return typed and _with_bounds(typed, graph, facets)


def _with_bounds(typed: PropertyType, graph: Graph, saying: Iterable[Node]) -> PropertyType:
    """Return a type with the bounds that the nodes state."""
    ends = {
        end: number
        for each in saying
        for facet, end in FACETS.items()
        for literal in graph.objects(each, facet)
        if (number := read_bound(literal)) is not None
    }
    return replace(typed, bounds=Bounds(**ends)) if ends else typed


def read_bound(node: Node) -> float | None:
    """Return the number of a facet or of an annotation that bounds numbers, None if it is no number."""
    try:
        return float(node.value) if isinstance(node, ox.Literal) else None
    except ValueError:
        return None


def _word(typed: PropertyType) -> str:
    match typed.type:
        case PlainType(name="Text"):
            return "a text"
        case PlainType(name="Bool"):
            return "true or false"
        case NumberType() | PlainType(name="Int"):
            return "a number"
        case _:
            return f"a {local_name(type(typed.type).__name__)}"


def _enumeration(graph: Graph, node: ox.BlankNode) -> PropertyType | None:
    lists = graph.objects(node, f"{OWL}oneOf")
    if not lists:
        return None
    return PropertyType(PlainType("Text"), tuple(m.value for m in graph.members(lists[0]) if isinstance(m, ox.Literal)))
