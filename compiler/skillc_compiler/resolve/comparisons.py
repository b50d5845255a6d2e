"""Comparisons and changes of numbers: both sides are typed, each by what the other one is."""

from __future__ import annotations

from collections.abc import Sequence

from skillc_compiler.program.expressions import NumberChange, TypedCondition, TypedExpression
from skillc_compiler.program.types import UNKNOWN, Thing
from skillc_compiler.resolve.links import compare_links, say_of
from skillc_compiler.resolve.references import expect_beside, to_term
from skillc_compiler.resolve.scope import FileContext, Scope
from skillc_compiler.resolve.values import resolve_value
from skillc_dsl import syntax as s
from skillc_model.conditions import (
    And,
    Compare,
    Individual,
    Not,
    PropertyOf,
    Same,
)
from skillc_model.conditions import Variable as VariableTerm


def resolve_comparison(context: FileContext, scope: Scope, written: s.Compare | s.Change) -> TypedCondition:
    """Return a comparison, or a change of a number, with both sides typed."""
    if isinstance(written, s.Change):
        return _resolve_change(context, scope, written)
    return _resolve_compare(context, scope, written)


def _resolve_compare(context: FileContext, scope: Scope, written: s.Compare) -> TypedCondition:
    left, right = _resolve_sides(context, scope, written)
    if written.operator in ("==", "!="):
        linked = compare_links(context, scope, left, right, written.operator == "==", written.span)
        if linked is not None:
            return linked
    individuals = [kind for kind in (left.type, right.type) if isinstance(kind, Thing)]
    if individuals and written.operator in ("==", "!=") and _all_terms(left, right):
        same = TypedCondition(Same(to_term(context, left), to_term(context, right)), written.span, (left, right))
        return same if written.operator == "==" else TypedCondition(Not(same.meaning), written.span, parts=(same,))

    def compare(sides: Sequence[TypedExpression]) -> TypedCondition:
        one, other = sides
        return TypedCondition(Compare(one.meaning, written.operator, other.meaning), written.span, (one, other))

    return say_of(context, scope, (left, right), compare)


def _resolve_change(context: FileContext, scope: Scope, written: s.Change) -> TypedCondition:
    of = resolve_value(context, scope, written.property)
    ends = (written.amount, written.amount if written.to is None else written.to)
    low, high = (
        None if isinstance(each, s.Anything) else resolve_value(context, scope, each, expect_beside(context, of))
        for each in ends
    )
    values = tuple(dict.fromkeys(each for each in (of, low, high) if each is not None))
    term = context.vocabulary.properties.get(of.meaning.property) if isinstance(of.meaning, PropertyOf) else None
    change = NumberChange(written.operator, of, low, high, term.bounds if term else None)
    return TypedCondition(And(()), written.span, values, change=change)


def _all_terms(*sides: TypedExpression) -> bool:
    return all(isinstance(side.meaning, VariableTerm | Individual) for side in sides)


def _resolve_sides(context: FileContext, scope: Scope, written: s.Compare) -> tuple[TypedExpression, TypedExpression]:
    """Resolve both sides; the side with the property first, as it determines the values that a bare name may be."""
    if isinstance(written.left, s.NameReference) and not is_local(scope, written.left):
        right = resolve_value(context, scope, written.right)
        return _resolve_other_side(context, scope, written.left, right), right
    left = resolve_value(context, scope, written.left)
    return left, _resolve_other_side(context, scope, written.right, left)


def is_local(scope: Scope, written: s.NameReference) -> bool:
    """Whether a name has a prefix, or is that of a parameter or variable."""
    return ":" in written.name.text or written.name.text in scope.variables


def _resolve_other_side(
    context: FileContext, scope: Scope, written: s.Value, known: TypedExpression
) -> TypedExpression:
    """Resolve the side that is compared with `known`; beside an unknown type, a bare name may be anything."""
    match written:
        case s.NameReference(name=s.Name(text=text), span=span) if known.type == UNKNOWN and ":" not in text:
            if text not in scope.variables:
                return TypedExpression(VariableTerm(text), UNKNOWN, span)
        case _:
            pass
    return resolve_value(context, scope, written, expect_beside(context, known))
