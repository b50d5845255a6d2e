"""Resolving what is computed of the individuals of a class: `count` and its like, and what a loop goes through."""

from __future__ import annotations

from collections.abc import Callable
from types import MappingProxyType
from typing import Literal as OneOf
from typing import TypeAlias, get_args

from skillc_compiler.program.expressions import TypedCondition, TypedExpression
from skillc_compiler.program.types import INT, TEXT, UNKNOWN, ListOf, Measure, Thing, Type
from skillc_compiler.program.unknown import UnknownName
from skillc_compiler.resolve.scope import FileContext, LocalName, Scope
from skillc_dsl import syntax as s
from skillc_dsl.source import Span
from skillc_dsl.units import NUMBER, TEMPERATURE
from skillc_model.conditions import Aggregate, And, Condition, Literal
from skillc_rdf.vocabulary.types import THING

Name: TypeAlias = OneOf["count", "sum", "min", "max", "mean"]
AGGREGATES: tuple[Name, ...] = get_args(Name)
"""The functions of the individuals of a class."""
ResolveValue: TypeAlias = Callable[[FileContext, Scope, s.Value], TypedExpression]

_ELSEWHERE = MappingProxyType(
    {
        **dict.fromkeys(("avg", "average"), "mean"),
        **dict.fromkeys(("len", "length", "size", "number"), "count"),
        **dict.fromkeys(("total", "add"), "sum"),
        **dict.fromkeys(("minimum", "least"), "min"),
        **dict.fromkeys(("maximum", "most"), "max"),
    }
)
"""What other languages call them."""


def resolve_aggregate(
    context: FileContext, scope: Scope, written: s.Aggregate, resolve_value: ResolveValue
) -> TypedExpression:
    """Return the typed expression; `resolve_value` resolves the value of each individual."""
    name = next((each for each in AGGREGATES if each == written.function.text), None)
    cls, inner, where = _resolve_members(context, scope, written.variable, written.cls, written.where)
    value = resolve_value(context, inner, written.value) if written.value is not None else None
    if name is None:
        _report_unknown(context, written.function)
        return TypedExpression(Literal(0), UNKNOWN, written.span)
    if (name == "count") is not (value is None):
        _report_value(context, name, written, value)
        return TypedExpression(Literal(0), UNKNOWN, written.span)
    meaning = Aggregate(name, written.variable.text, cls, _meaning(where), value.meaning if value else Literal(1))
    kind = INT if value is None else aggregate_type(name, value.type) or UNKNOWN
    return TypedExpression(meaning, kind, written.span, () if value is None else (value,), conditions=where)


def resolve_every(
    context: FileContext, scope: Scope, variable: s.Name, written: s.Every, resolve_value: ResolveValue
) -> TypedExpression:
    """Return the list of individuals that a loop goes through."""
    cls, inner, where = _resolve_members(context, scope, variable, written.cls, written.where)
    by = resolve_value(context, inner, written.by) if written.by is not None else None
    order = by.meaning if by is not None else Literal(0)
    meaning = Aggregate("ordered", variable.text, cls, _meaning(where), order)
    kind = inner.variables[variable.text].type
    return TypedExpression(meaning, ListOf(kind), written.span, () if by is None else (by,), conditions=where)


def aggregate_type(name: str, value: Type) -> Type | None:
    """Return the type of an aggregate of values of a type; None if it does not apply to such values."""
    match name, value:
        case _, _ if value == UNKNOWN:
            return UNKNOWN
        case "sum", Measure(dimension=dimension) if dimension == TEMPERATURE:
            return None
        case "mean", _ if value == INT:
            return Measure(NUMBER)
        case "ordered", _ if value == TEXT:
            return value
        case _, Measure():
            return value
    return value if value == INT else None


def _resolve_members(
    context: FileContext, scope: Scope, variable: s.Name, cls: s.Name, where: s.Condition | None
) -> tuple[str, Scope, tuple[TypedCondition, ...]]:
    """Return the class, the scope with the variable, and the condition, if there is one."""
    iri = context.names.look_up_term("class", cls)
    kind = (Thing(None) if iri == THING else Thing(iri)) if iri else UNKNOWN
    inner = context.bind(scope, variable, LocalName(kind, "variable", variable.span))
    return iri or THING, inner, () if where is None else (context.resolve_condition(context, inner, where),)


def _meaning(where: tuple[TypedCondition, ...]) -> Condition:
    return where[0].meaning if where else And(())


def _report_unknown(context: FileContext, name: s.Name) -> None:
    text = name.text
    message = f"there is no function `{text}` of the individuals of a class"
    if text in context.names.skills:
        help_ = f"write `do {text}(..)` to run it"
        context.report("unknown-function", name.span, f"the skill `{text}` is not a value", help_)
    elif text in _ELSEWHERE:
        context.report("unknown-function", name.span, message, f"write `{_ELSEWHERE[text]}`")
    else:
        otherwise = f"there are {', '.join(f'`{each}`' for each in AGGREGATES)}"
        context.report_unknown(UnknownName("function", name, message, AGGREGATES, otherwise))


def _report_value(context: FileContext, name: Name, written: s.Aggregate, value: TypedExpression | None) -> None:
    members = f"{written.variable.text}: {written.cls.text}"
    if value is None:
        message = f"`{name}` needs a value of each `{written.variable.text}`"
        help_ = f"write it last: `{name}({members}, {written.variable.text}.property)`"
        place: Span = written.span
    else:
        message, place = "`count` counts individuals and takes no value of them", value.span
        help_ = f"delete it, write `sum({members}, ..)`, or a condition after `where`"
    context.report("aggregate-value", place, message, help_)
