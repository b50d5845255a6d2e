"""The types that type names denote."""

from __future__ import annotations

from skillc_compiler.program.unknown import UnknownName
from skillc_compiler.resolve.names import Names
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.spelling import close_names, did_you_mean
from skillc_dsl.units import DIMENSIONS
from skillc_rdf.vocabulary.types import ClassType, DirectionType, ListType, NumberType, PlainType, ValueType, VectorType

UNRESOLVED_TYPE = NumberType("?")
BUILT_IN: dict[str, ValueType] = {
    **{name: NumberType(name) for name in DIMENSIONS},
    "Bool": PlainType("Bool"),
    "Int": PlainType("Int"),
    "Text": PlainType("Text"),
    "Pose": PlainType("Pose"),
    "Vector": VectorType("Number"),
    "Direction": DirectionType(),
}


def resolve_type(names: Names, written: s.TypeName) -> ValueType:
    """Return the type; an unknown name is reported, and UNRESOLVED_TYPE is returned for it."""
    match written:
        case s.ListOf(element=element):
            return ListType(resolve_type(names, element))
        case s.OfDimension():
            return _of_dimension(names, written)
        case s.Name(text=text) if text in BUILT_IN:
            return BUILT_IN[text]
        case s.Name(text=text) if ":" not in text and not names.is_term("class", text):
            return _unknown(names, written)
        case s.Name():
            return _class(names, written)


def _of_dimension(names: Names, written: s.OfDimension) -> ValueType:
    """Return the type of `Vector of DIMENSION`; anything else before or after `of` is reported."""
    of, dimension = written.of, written.dimension
    if of.text != "Vector":
        message = f"only a `Vector` has a dimension, and this is `{of.text}`"
        help_ = f"write `{dimension.text}` alone" if of.text in DIMENSIONS else f"write `{of.text}` alone"
        names.problems.append(Diagnostic("unknown-type", written.span, message, help=help_))
        return UNRESOLVED_TYPE
    if dimension.text not in DIMENSIONS:
        message = f"there is no dimension `{dimension.text}`"
        help_ = did_you_mean(dimension.text, DIMENSIONS)
        names.problems.append(Diagnostic("unknown-type", dimension.span, message, help=help_))
        return UNRESOLVED_TYPE
    return VectorType(dimension.text)


def _class(names: Names, written: s.Name) -> ValueType:
    iri = names.look_up_term("class", written)
    return ClassType(iri) if iri else UNRESOLVED_TYPE


def _unknown(names: Names, written: s.Name) -> ValueType:
    """Report an unknown type: as a class, unless a built-in type is probably meant."""
    near = (
        () if names.find_line("class", written.text) else close_names(written.text, {*BUILT_IN, *names.bare["class"]})
    )
    if near and BUILT_IN.keys() >= {*near}:
        message = f"there is no type `{written.text}`"
        names.unknown.append(UnknownName("type", written, message, tuple(BUILT_IN)))
        return UNRESOLVED_TYPE
    return _class(names, written)
