"""Understanding values: what they mean, in SI units, and their types."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import assert_never

from skillc_compiler.library.conditions import (
    Arithmetic,
    Individual,
    Invoke,
    Literal,
    PropertyOf,
    Variable,
)
from skillc_compiler.program.typed import Valued
from skillc_compiler.program.types import (
    BOOL,
    INT,
    TEXT,
    UNKNOWN,
    Direction,
    Measure,
    Thing,
    Type,
    Vector,
    fits,
    of_library,
)
from skillc_compiler.resolve.scope import Scope, Setting
from skillc_dsl import syntax as s
from skillc_dsl.units import NUMBER, dimension_of, to_si


@dataclass(frozen=True, slots=True)
class Wanted:
    """What fits where a value stands: near misses are chosen by it, and a bare name may be one of `values`."""

    type: Type = UNKNOWN
    values: tuple[str, ...] = ()


ANYTHING = Wanted()


def value(setting: Setting, scope: Scope, written: s.Value, wanted: Wanted = ANYTHING) -> Valued:
    """Return what a value means; what cannot be understood is reported and has an unknown type."""
    match written:
        case s.Quantity(value=number, unit=unit, span=span):
            return Valued(Literal(to_si(number, unit)), Measure(dimension_of(unit)), span)
        case s.Number(value=number, text=text, span=span):
            whole = text.lstrip("-").isdigit() and isfinite(number)
            return Valued(Literal(int(number) if whole else number), INT if whole else Measure(NUMBER), span)
        case s.Text(value=text, span=span):
            if wanted.values and text not in wanted.values:
                _unknown_value(setting, s.Name(text, span), wanted)
            return Valued(Literal(text), TEXT, span)
        case s.Boolean(value=truth, span=span):
            return Valued(Literal(truth), BOOL, span)
        case s.Reference():
            return _reference(setting, scope, written, wanted)
        case s.Member():
            return _member(setting, scope, written)
        case s.Apply():
            return _apply(setting, scope, written)
        case s.Arithmetic():
            return _arithmetic(setting, scope, written)
        case _:
            assert_never(written)


def _reference(setting: Setting, scope: Scope, written: s.Reference, wanted: Wanted) -> Valued:
    text, span = written.name.text, written.span
    if ":" in text:
        return _individual(setting, written, wanted)
    known = scope.variables.get(text)
    if known is not None:
        if not known.sure:
            setting.report(
                "out-unassigned",
                span,
                f"`{text}` has no value here on every path",
                f"assign it before, with `-> {text}` on a call that always runs",
            )
        return Valued(Variable(text), known.type, span)
    if text in wanted.values:
        return Valued(Literal(text), TEXT, span)
    if wanted.values:
        _unknown_value(setting, written.name, wanted)
    else:
        _unknown_name(setting, scope, written, wanted)
    return Valued(Variable(text), UNKNOWN, span)


def _unknown_value(setting: Setting, name: s.Name, wanted: Wanted) -> None:
    message = f"`{name.text}` is no value of this property"
    setting.report_unknown("unknown-value", name, message, wanted.values, f"it is {' or '.join(wanted.values)}")


def _unknown_name(setting: Setting, scope: Scope, written: s.Reference, wanted: Wanted) -> None:
    fitting = [n for n, v in scope.variables.items() if fits(setting.vocabulary, v.type, wanted.type)]
    setting.report_unknown(
        "unknown-parameter",
        written.name,
        f"{scope.owner} has no parameter or other name `{written.name.text}`",
        fitting,
        "an individual is written with its prefix: `lab:Board-1`",
    )


def _individual(setting: Setting, written: s.Reference, wanted: Wanted) -> Valued:
    iri = setting.names.individual(written.name)
    if iri is None:
        return Valued(Individual(written.name.text), UNKNOWN, written.span)
    kind = setting.names.kind_of(iri)
    if kind is not None:
        setting.report(
            "not-an-individual",
            written.span,
            f"`{written.name.text}` is a {kind}, where an individual or a value is expected",
            "write a parameter, or an individual of the scene",
        )
        return Valued(Individual(iri), UNKNOWN, written.span)
    return Valued(Individual(iri), _class_of(setting, written, iri, wanted), written.span)


def _class_of(setting: Setting, written: s.Reference, iri: str, wanted: Wanted) -> Type:
    """Return the type of an individual; one that the scene does not have is reported."""
    known = setting.individuals
    if known is None:
        return Thing(None)
    if iri in known:
        return Thing(known[iri])
    fitting = [other for other, cls in known.items() if fits(setting.vocabulary, Thing(cls), wanted.type)]
    message = f"there is no `{written.name.text}` in the scene"
    setting.report_unknown("unknown-individual", written.name, message, [setting.names.short(i) for i in fitting])
    return UNKNOWN


def _member(setting: Setting, scope: Scope, written: s.Member) -> Valued:
    of = value(setting, scope, written.of)
    iri = property_of(setting, of, written.property)
    if iri is None:
        return Valued(PropertyOf(of.meaning, written.property.text), UNKNOWN, written.span, (of,))
    kind = of_library(setting.vocabulary.properties[iri].type)
    return Valued(PropertyOf(of.meaning, iri), kind, written.span, (of,))


def property_of(setting: Setting, of: Valued, name: s.Name) -> str | None:
    """Return the IRI of a property; near misses are those that `of` can have."""
    names, vocabulary = setting.names, setting.vocabulary
    if names.is_term("relation", name.text) and not names.is_term("property", name.text):
        setting.report(
            "unknown-property",
            name.span,
            f"`{name.text}` is a relation between individuals, not a property",
            f"write it between two individuals: `a {name.text} b`",
        )
        return None
    return names.term(
        "property",
        name,
        lambda iri: any(fits(vocabulary, of.type, Thing(domain)) for domain in vocabulary.properties[iri].domains),
    )


def _apply(setting: Setting, scope: Scope, written: s.Apply) -> Valued:
    function = setting.names.function(written.function)
    wanted = [of_library(kind) for _, kind in function.parameters] if function else []
    wanted += [UNKNOWN] * (len(written.arguments) - len(wanted))
    arguments = tuple(
        value(setting, scope, argument, Wanted(kind)) for argument, kind in zip(written.arguments, wanted, strict=False)
    )
    result = of_library(function.result) if function else UNKNOWN
    meaning = Invoke(written.function.text, tuple(a.meaning for a in arguments))
    return Valued(meaning, result, written.span, arguments)


def _arithmetic(setting: Setting, scope: Scope, written: s.Arithmetic) -> Valued:
    left, right = value(setting, scope, written.left), value(setting, scope, written.right)
    meaning = Arithmetic(written.operator, left.meaning, right.meaning)
    turned = _is_turned(written.operator, left, right)
    kind = Direction() if turned else result_type(written.operator, left.type, right.type)
    return Valued(meaning, kind or UNKNOWN, written.span, (left, right))


def _is_turned(operator: str, left: Valued, right: Valued) -> bool:
    """Whether this is a direction times or by 1 or -1, which is a direction still."""
    one, other = (right, left) if operator == "*" and isinstance(right.type, Direction) else (left, right)
    is_one = _number(other.type) == Measure(NUMBER) and other.meaning in (Literal(1), Literal(-1))
    return operator in ("*", "/") and isinstance(one.type, Direction) and is_one


def result_type(operator: str, left: Type, right: Type) -> Type | None:
    """Return the type of `left operator right`, None where the operator does not apply to such values."""
    if UNKNOWN in (left, right):
        return UNKNOWN
    if (left, right) == (INT, INT) and operator != "/":
        return INT
    match operator, _number(left), _number(right):
        case "+" | "-", Measure() | Vector() as one, other:
            return one if one == other else None
        case "*", Measure(one), Measure(other):
            return Measure(one * other)
        case "/", Measure(one), Measure(other):
            return Measure(one / other)
        case ("*", Vector(one), Measure(other)) | ("*", Measure(one), Vector(other)):
            return Vector(one * other)
        case "/", Vector(one), Measure(other):
            return Vector(one / other)
    return None


def _number(kind: Type) -> Type:
    """Return what a type is to arithmetic: a whole number is a number, a direction a vector of pure numbers."""
    match kind:
        case Direction():
            return Vector(NUMBER)
        case _:
            return Measure(NUMBER) if kind == INT else kind
