"""The types that type names denote, and ranges of numbers: `property charge(Robot): Energy range 0 Wh .. 100 Wh`."""

from __future__ import annotations

from types import MappingProxyType

from skillc_compiler.program.types import INT, Measure, Type, describe_type, type_of
from skillc_compiler.program.unknown import UnknownName
from skillc_compiler.resolve.names import Names
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.spelling import close_names, did_you_mean
from skillc_dsl.units import DIMENSIONS, LATER_DIMENSIONS, NUMBER, UNITS, to_si
from skillc_rdf.vocabulary.types import (
    Bounds,
    ClassType,
    DirectionType,
    ListType,
    NumberType,
    PlainType,
    ValueType,
    VectorType,
)

UNRESOLVED_TYPE = NumberType("?")
BUILT_IN: dict[str, ValueType] = {
    **{name: NumberType(name) for name in DIMENSIONS},
    "Bool": PlainType("Bool"),
    "Int": PlainType("Int"),
    "Text": PlainType("Text"),
    "Message": PlainType("Message"),
    "Pose": PlainType("Pose"),
    "Vector": VectorType("Number"),
    "Direction": DirectionType(),
}

_FOREIGN = MappingProxyType(
    {
        **dict.fromkeys(("float", "double", "real"), "Number"),
        **dict.fromkeys(("string", "String", "str"), "Text"),
        **dict.fromkeys(("boolean", "Boolean"), "Bool"),
        **dict.fromkeys(("integer", "Integer"), "Int"),
    }
)
"""Types as other languages call them."""


LATER = LATER_DIMENSIONS | {"Message"}
"""The built-in types that came after the first edition: a class of their name goes before them."""


def is_built_in(text: str, is_class: bool) -> bool:
    """Whether a name means a built-in type; those that came later give way to a class of their name."""
    return text in BUILT_IN and not (is_class and text in LATER)


def resolve_type(names: Names, written: s.TypeName) -> ValueType:
    """Return the type; an unknown name is reported, and UNRESOLVED_TYPE is returned for it."""
    match written:
        case s.ListOf(element=element):
            return ListType(resolve_type(names, element))
        case s.OfDimension():
            return _of_dimension(names, written)
        case s.Name(text=text) if is_built_in(text, names.is_term("class", text)):
            return BUILT_IN[text]
        case s.Name(text=text) if ":" not in text and not names.is_term("class", text):
            return _unknown(names, written)
        case s.Name():
            return _class(names, written)


def _of_dimension(names: Names, written: s.OfDimension) -> ValueType:
    """Return the type of `Vector of DIMENSION`; anything else before or after `of` is reported."""
    of, dimension = written.of, written.dimension
    if of.text != "Vector":
        if of.text in ("list", "List", "array", "Array"):
            _report_foreign(names, written, of.text, f"[{dimension.text}]")
            return UNRESOLVED_TYPE
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
    meant = _FOREIGN.get(written.text)
    if meant is not None and not names.find_line("class", written.text):
        _report_foreign(names, written, written.text, meant)
        return UNRESOLVED_TYPE
    near = (
        () if names.find_line("class", written.text) else close_names(written.text, {*BUILT_IN, *names.bare["class"]})
    )
    if near and BUILT_IN.keys() >= {*near}:
        message = f"there is no type `{written.text}`"
        names.unknown.append(UnknownName("type", written, message, tuple(BUILT_IN)))
        return UNRESOLVED_TYPE
    return _class(names, written)


def _report_foreign(names: Names, written: s.TypeName, text: str, meant: str) -> None:
    """Report the name of a type in another language."""
    help_ = f"write `{meant}`"
    fix = Fix(written.span, meant, help_)
    names.problems.append(Diagnostic("unknown-type", written.span, f"there is no type `{text}`", help_, fix=fix))


def resolve_bounds(written: s.Range | None, declared: ValueType, names: Names) -> Bounds | None:
    """Return the bounds of a property in SI units; None without a range, or if it is wrong, which is reported."""
    kind = type_of(declared)
    if written is None or not (kind == INT or isinstance(kind, Measure)):
        if written is not None:
            message = f"a range bounds a number, and this is {describe_type(kind)}"
            names.problems.append(Diagnostic("wrong-type", written.span, message, help="remove the range"))
        return None
    low, high = (_constant(each, kind, names) for each in (written.low, written.high))
    if low is None or high is None:
        return None
    if low > high:
        message = "no value is in this range: its lower bound is the greater one"
        names.problems.append(Diagnostic("empty-range", written.span, message, help="write the lower bound first"))
        return None
    return Bounds(least=low, greatest=high)


def _constant(written: s.Value, kind: Type, names: Names) -> float | None:
    match written:
        case s.Number(value=value) if kind in (INT, Measure(NUMBER)):
            return float(value)
        case s.Quantity(value=value, unit=unit) if (
            isinstance(kind, Measure) and UNITS[unit].dimension == kind.dimension
        ):
            return to_si(value, unit)
    message = f"a bound is a constant, here {describe_type(kind)}"
    problem = Diagnostic("wrong-type", written.span, message, help="write a number with its unit, such as `0 N`")
    names.problems.append(problem)
    return None
