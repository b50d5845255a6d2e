"""Resolving texts with values: `"{force} is too much"`."""

from __future__ import annotations

from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.types import MESSAGE, declared_as
from skillc_compiler.resolve.aggregates import ResolveValue
from skillc_compiler.resolve.scope import FileContext, Scope
from skillc_dsl import syntax as s
from skillc_model.conditions import Literal, Message, NamedValue


def resolve_message(
    context: FileContext, scope: Scope, written: s.Message, resolve_value: ResolveValue
) -> TypedExpression:
    """Resolve a text with values; one without is a constant, in which braces stand once."""
    values = tuple(resolve_value(context, scope, value) for value in written.values)
    if not values:
        return TypedExpression(Literal("".join(map(str, written.parts))), MESSAGE, written.span)
    named = {_written(value): found for value, found in zip(written.values, values, strict=True)}
    known = tuple(NamedValue(name, found.meaning, declared_as(found.type)) for name, found in named.items())
    return TypedExpression(Message(written.text, known), MESSAGE, written.span, values)


def _written(value: s.NameReference | s.Member) -> str:
    """Return a value in a text as it is written between the braces."""
    if isinstance(value, s.Member) and isinstance(value.of, s.NameReference):
        return f"{value.of.name.text}.{value.property.text}"
    assert isinstance(value, s.NameReference)
    return value.name.text
