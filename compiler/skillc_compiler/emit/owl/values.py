"""Types and values in OWL: a type is an IRI, a constant a typed literal, with the unit as a separate statement."""

from __future__ import annotations

from collections.abc import Iterator
from typing import assert_never

from skillc_compiler.emit.owl.turtle import RDF_TYPE, IriNode, Object
from skillc_compiler.emit.owl.words import DATATYPES, DIMENSION, RDFS, SKILLC, XSD
from skillc_model.conditions import Expression, Individual, Literal
from skillc_model.format_condition import format_expression
from skillc_model.format_type import SI_UNITS
from skillc_model.rewriting import constant_number
from skillc_rdf.vocabulary.types import (
    ClassType,
    DirectionType,
    ListType,
    NumberType,
    PlainType,
    ValueType,
    VectorType,
    Vocabulary,
)

Statement = tuple[str, str, Object]


def type_statements(subject: str, type_: ValueType) -> Iterator[Statement]:
    """Yield the statements of a parameter's type, its SI unit, and whether its value is a list."""
    element = type_.element if isinstance(type_, ListType) else type_
    yield subject, f"{SKILLC}parameterType", IriNode(_type_iri(element))
    if element is not type_:
        yield subject, f"{SKILLC}isList", True
    if isinstance(element, NumberType | VectorType) and element.dimension in SI_UNITS:
        yield subject, f"{SKILLC}unit", SI_UNITS[element.dimension]
        yield from _dimension(element.dimension)


def convert_value(expression: Expression, type_: ValueType, vocabulary: Vocabulary) -> Object:
    """Return a constant as a typed literal or an individual, any other expression as text."""
    match expression:
        case Individual(iri=iri):
            return IriNode(iri)
        case Literal(value=bool() | str() as plain):
            return plain
        case Literal(value=int() as whole) if type_ == PlainType("Int"):
            return whole
    number = constant_number(expression)
    return format_expression(expression, vocabulary) if number is None else number


def _type_iri(type_: ValueType) -> str:
    match type_:
        case ClassType(iri=iri):
            return iri
        case NumberType(dimension=dimension):
            return f"{SKILLC}{dimension}" if dimension in SI_UNITS else f"{XSD}double"
        case VectorType():
            return f"{SKILLC}Vector"
        case DirectionType():
            return f"{SKILLC}Direction"
        case PlainType(name=name):
            return DATATYPES.get(name, f"{SKILLC}{name}")
        case ListType(element=element):
            return _type_iri(element)
        case _:
            assert_never(type_)


def _dimension(name: str) -> Iterator[Statement]:
    yield f"{SKILLC}{name}", RDF_TYPE, IriNode(DIMENSION)
    yield f"{SKILLC}{name}", f"{RDFS}label", name
    yield f"{SKILLC}{name}", f"{SKILLC}unit", SI_UNITS[name]
