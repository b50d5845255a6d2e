"""What a written type means."""

from __future__ import annotations

from skillc_compiler.library.vocabulary import (
    ClassType,
    ListType,
    NumberType,
    PlainType,
    ValueType,
    VectorType,
)
from skillc_compiler.resolve.names import Names
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, did_you_mean
from skillc_dsl.units import DIMENSIONS

NOT_UNDERSTOOD = NumberType("?")
BUILT_IN: dict[str, ValueType] = {
    **{name: NumberType(name) for name in DIMENSIONS},
    "Bool": PlainType("Bool"),
    "Int": PlainType("Int"),
    "Text": PlainType("Text"),
    "Pose": PlainType("Pose"),
    "Vector": VectorType("Number"),
}


def value_type(names: Names, written: s.TypeName) -> ValueType:
    """Return the type; a name that means none is reported, and NOT_UNDERSTOOD is returned for it."""
    match written:
        case s.ListOf(element=element):
            return ListType(value_type(names, element))
        case s.Name(text=text) if text in BUILT_IN:
            return BUILT_IN[text]
        case s.Name(text=text) if ":" not in text and not names.is_term("class", text):
            return _unknown(names, written)
        case s.Name():
            return _class(names, written)


def _class(names: Names, written: s.Name) -> ValueType:
    iri = names.term("class", written)
    return ClassType(iri) if iri else NOT_UNDERSTOOD


def _unknown(names: Names, written: s.Name) -> ValueType:
    """Report an unknown type; near misses are classes and built-in types alike."""
    close = did_you_mean(written.text, BUILT_IN)
    if close.startswith("did you mean"):
        names.problems.append(
            Diagnostic("unknown-type", written.span, f"there is no type `{written.text}`", help=close)
        )
        return NOT_UNDERSTOOD
    return _class(names, written)
