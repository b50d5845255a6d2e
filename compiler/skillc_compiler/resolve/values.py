"""Resolving expressions: their meaning, in SI units, and their types."""

from __future__ import annotations

from math import isfinite
from types import MappingProxyType
from typing import assert_never

from skillc_compiler.program.arithmetic import arithmetic_type, as_number_type
from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.labels import declaration_place
from skillc_compiler.program.types import (
    BOOL,
    INT,
    MESSAGE,
    TEXT,
    UNKNOWN,
    Direction,
    ListOf,
    Measure,
    Thing,
    Type,
    fits,
    type_of,
)
from skillc_compiler.program.unknown import UnknownName
from skillc_compiler.resolve.aggregates import resolve_aggregate
from skillc_compiler.resolve.links import type_of_link
from skillc_compiler.resolve.references import ANYTHING, ExpectedType, report_unknown_value, resolve_reference
from skillc_compiler.resolve.scope import FileContext, Scope
from skillc_compiler.resolve.texts import resolve_message
from skillc_dsl import syntax as s
from skillc_dsl.messages import read_message
from skillc_dsl.units import NUMBER, dimension_of, to_si
from skillc_model.conditions import (
    Arithmetic,
    Invoke,
    ListValue,
    Literal,
    PropertyOf,
    Variable,
)
from skillc_model.tree import FAILURE_PARTS
from skillc_rdf.vocabulary.types import Vocabulary


def resolve_value(
    context: FileContext, scope: Scope, written: s.Value, wanted: ExpectedType = ANYTHING
) -> TypedExpression:
    """Return the typed expression; unresolved parts are reported and have an unknown type."""
    match written:
        case s.Quantity(value=number, unit=unit, span=span):
            return TypedExpression(Literal(to_si(number, unit)), Measure(dimension_of(unit)), span)
        case s.Number(value=number, text=text, span=span):
            whole = text.lstrip("-").isdigit() and isfinite(number)
            return TypedExpression(Literal(int(number) if whole else number), INT if whole else Measure(NUMBER), span)
        case s.Text():
            return _resolve_text(context, scope, written, wanted)
        case s.Boolean(value=truth, span=span):
            return TypedExpression(Literal(truth), BOOL, span)
        case s.NameReference():
            return resolve_reference(context, scope, written, wanted)
        case s.Member():
            return _resolve_member(context, scope, written)
        case s.Invoke():
            return _resolve_apply(context, scope, written)
        case s.Arithmetic():
            return _resolve_arithmetic(context, scope, written)
        case s.ListValue():
            return _resolve_list(context, scope, written, wanted)
        case s.Aggregate():
            return resolve_aggregate(context, scope, written, resolve_value)
        case _:
            assert_never(written)


def _resolve_text(context: FileContext, scope: Scope, written: s.Text, wanted: ExpectedType) -> TypedExpression:
    if wanted.type != MESSAGE:
        if wanted.values and written.value not in wanted.values:
            report_unknown_value(context, s.Name(written.value, written.span), wanted)
        return TypedExpression(Literal(written.value), TEXT, written.span)
    message, problems = read_message(written)
    for problem in problems:
        context.report(problem.name, problem.span, problem.message, problem.help)
    return resolve_message(context, scope, message, resolve_value)


def _resolve_list(context: FileContext, scope: Scope, written: s.ListValue, wanted: ExpectedType) -> TypedExpression:
    """Resolve a list; its type is that of the first item to which all others fit, or else that of the first one."""
    element = ExpectedType(wanted.type.element) if isinstance(wanted.type, ListOf) else ANYTHING
    items = tuple(resolve_value(context, scope, item, element) for item in written.items)
    kinds = [item.type for item in items]
    common = (kind for kind in kinds if all(fits(context.vocabulary, other, kind) for other in kinds))
    meaning = ListValue(tuple(item.meaning for item in items))
    return TypedExpression(meaning, ListOf(next(common, kinds[0])), written.span, items)


def _resolve_member(context: FileContext, scope: Scope, written: s.Member) -> TypedExpression:
    part = _part_of_failure(context, scope, written)
    if part is not None:
        return part
    of = resolve_value(context, scope, written.of)
    iri = resolve_property(context, of, written.property)
    if iri is None:
        return TypedExpression(PropertyOf(of.meaning, written.property.text), UNKNOWN, written.span, (of,))
    vocabulary = context.vocabulary
    if iri in vocabulary.relations:
        kind = type_of_link(vocabulary, vocabulary.relations[iri], of.type)
    else:
        kind = type_of(vocabulary.properties[iri].type)
    return TypedExpression(PropertyOf(of.meaning, iri), kind, written.span, (of,))


def _part_of_failure(context: FileContext, scope: Scope, written: s.Member) -> TypedExpression | None:
    """Return what `why.kind` and its like stand for; None for properties."""
    if not isinstance(written.of, s.NameReference):
        return None
    name, part = written.of.name.text, written.property.text
    known = scope.variables.get(name)
    if known is None or known.origin != "failure":
        return None
    if part not in FAILURE_PARTS:
        message = f"`{name}` is why something failed, and has no `{part}`"
        context.report_unknown(UnknownName("property", written.property, message, FAILURE_PARTS))
        return TypedExpression(Variable(name), UNKNOWN, written.span)
    return TypedExpression(Variable(f"{name}.{part}"), known.type, written.span, declared=known.span)


def _is_link(context: FileContext, of: TypedExpression, name: s.Name) -> bool:
    """Whether a name after a dot is that of a relation.

    One that is a property as well is what `of` can have; if it can have both, that which a library declares.
    """
    names, vocabulary = context.names, context.vocabulary
    if not names.is_term("relation", name.text) or not names.is_term("property", name.text):
        return names.is_term("relation", name.text)
    links, values = (names.bare[kind].get(name.text, ()) for kind in ("relation", "property"))
    starts = (each.domain for iri in links for each in vocabulary.relations[iri].signatures)
    owners = (each for iri in values for each in vocabulary.properties[iri].domains)
    if not any(fits(vocabulary, of.type, Thing(each)) for each in starts):
        return False
    if not any(fits(vocabulary, of.type, Thing(each)) for each in owners):
        return True
    places = (vocabulary.relations[iri].source for iri in links)
    return all(each is not None and each.path.endswith(".skill") for each in places)


def resolve_property(context: FileContext, of: TypedExpression, name: s.Name) -> str | None:
    """Return the IRI of a property, or of a functional relation; suggestions are properties that `of` can have."""
    names, vocabulary = context.names, context.vocabulary
    if _is_link(context, of, name):
        iri = names.look_up_term("relation", name)
        if iri is None or vocabulary.relations[iri].functional:
            return iri
        context.report(
            "unknown-property",
            name.span,
            f"`{name.text}` is a relation that may hold of several things, not a property",
            f"write it between two individuals: `a {name.text} b`, or declare it `functional`",
        )
        return None
    return names.look_up_term(
        "property",
        name,
        lambda iri: any(fits(vocabulary, of.type, Thing(domain)) for domain in vocabulary.properties[iri].domains),
        (text for text, iris in names.bare["relation"].items() if _is_read(vocabulary, iris[0], of.type)),
    )


def _is_read(vocabulary: Vocabulary, relation: str, of: Type) -> bool:
    """Whether there is one thing at most that a relation of a thing leads to, so that it is written after a dot."""
    term = vocabulary.relations.get(relation)
    if term is None or not term.functional:
        return False
    return any(fits(vocabulary, of, Thing(each.domain)) for each in term.signatures)


_FUNCTIONS = MappingProxyType(
    {
        "range": "write `repeat 3 { .. }`, or `for x in LIST { .. }` with a parameter of a type such as `[Pose]`",
        **dict.fromkeys(("len", "size", "length", "count"), "individuals are counted by `count(x: Class where C)`"),
        **dict.fromkeys(("sleep", "wait"), "write `wait 1 s` among the steps"),
        **dict.fromkeys(("print", "log", "printf"), "delete it: what happens in a run is recorded"),
    }
)
"""What is written instead of functions of other languages."""


def _resolve_apply(context: FileContext, scope: Scope, written: s.Invoke) -> TypedExpression:
    name = written.function.text
    instead = _FUNCTIONS.get(name)
    if instead is not None and name not in context.names.functions and context.names.elsewhere.get(name) is None:
        context.report("unknown-function", written.function.span, f"there is no function `{name}`", instead)
        return TypedExpression(Invoke(name, ()), UNKNOWN, written.span)
    function = context.names.look_up_function(written.function)
    wanted = [type_of(kind) for _, kind in function.parameters] if function else []
    wanted += [UNKNOWN] * (len(written.arguments) - len(wanted))
    arguments = tuple(
        resolve_value(context, scope, argument, ExpectedType(kind))
        for argument, kind in zip(written.arguments, wanted, strict=False)
    )
    result = type_of(function.result) if function else UNKNOWN
    meaning = Invoke(written.function.text, tuple(a.meaning for a in arguments))
    declared = declaration_place(function) if function else None
    return TypedExpression(meaning, result, written.span, arguments, declared)


def _resolve_arithmetic(context: FileContext, scope: Scope, written: s.Arithmetic) -> TypedExpression:
    left, right = resolve_value(context, scope, written.left), resolve_value(context, scope, written.right)
    meaning = Arithmetic(written.operator, left.meaning, right.meaning)
    turned = _is_signed_direction(written.operator, left, right)
    kind = Direction() if turned else arithmetic_type(written.operator, left.type, right.type)
    return TypedExpression(meaning, kind or UNKNOWN, written.span, (left, right))


def _is_signed_direction(operator: str, left: TypedExpression, right: TypedExpression) -> bool:
    """Whether this is a direction times or divided by 1 or -1, which is still a direction."""
    one, other = (right, left) if operator == "*" and isinstance(right.type, Direction) else (left, right)
    is_one = as_number_type(other.type) == Measure(NUMBER) and other.meaning in (Literal(1), Literal(-1))
    return operator in ("*", "/") and isinstance(one.type, Direction) and is_one
