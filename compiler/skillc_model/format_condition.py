"""Conditions, expressions and facts as text in the syntax of the language, in SI units.

A number has its unit where it is compared with a property; others are plain.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import assert_never

from skillc_model.conditions import (
    Aggregate,
    And,
    Anything,
    Arithmetic,
    Compare,
    Condition,
    Exists,
    Expression,
    Forall,
    ForEach,
    Given,
    HasProperty,
    Holds,
    Individual,
    Invoke,
    IsA,
    ListValue,
    Literal,
    Message,
    Not,
    Or,
    PropertyOf,
    Same,
    Term,
    Variable,
    wanted_by,
)
from skillc_model.format_type import in_written_unit
from skillc_rdf.vocabulary.types import NumberType, Vocabulary, local_name, value_name


def format_condition(condition: Condition, vocabulary: Vocabulary) -> str:
    """Return the condition in the syntax of the language; an empty `and` is `true`, an empty `or` is `false`."""
    match condition:
        case Holds(subject=subject, relation=relation, object=object_):
            term = vocabulary.relations.get(relation)
            is_value = isinstance(object_, Individual) and object_.iri in vocabulary.enumerated
            written = format_property if term and term.functional and is_value else format_relation
            return written(_term(subject, vocabulary), relation, _term(object_, vocabulary))
        case Compare(left=left, operator=operator, right=right):
            return f"{_format_side(left, right, vocabulary)} {operator} {_format_side(right, left, vocabulary)}"
        case Same(left=left, right=right):
            return f"{_term(left, vocabulary)} == {_term(right, vocabulary)}"
        case HasProperty(subject=subject, property=iri):
            return f"{_term(subject, vocabulary)} has {local_name(iri)}"
        case IsA(subject=subject, cls=cls):
            return format_class(_term(subject, vocabulary), vocabulary.short(cls))
        case Given(parameter=name):
            return f"given {name}"
        case Not(body=body):
            return f"not {_nested(body, vocabulary)}"
        case And(parts=parts):
            return format_all([_nested(part, vocabulary) for part in parts])
        case Or(parts=parts):
            return format_any([_nested(part, vocabulary) for part in parts])
        case Exists(variable=variable, cls=cls, body=body):
            return format_quantified("exists", variable, vocabulary.short(cls), format_condition(body, vocabulary))
        case Forall(variable=variable, cls=cls, body=body):
            return format_quantified("forall", variable, vocabulary.short(cls), format_condition(body, vocabulary))
        case _:
            assert_never(condition)


def _format_side(side: Expression, other: Expression, vocabulary: Vocabulary) -> str:
    """Return one side of a comparison or a sum: a number with the unit of the numbers that are the other side."""
    if isinstance(side, Literal) and isinstance(side.value, int | float) and not isinstance(side.value, bool):
        dimension = _dimension_of(other, vocabulary)
        if dimension is not None:
            written, unit = in_written_unit(side.value, dimension)
            return f"{format_literal(written)} {unit}".strip()
    return format_expression(side, vocabulary)


def _dimension_of(expression: Expression, vocabulary: Vocabulary) -> str | None:
    """Return the dimension of a number of the world; None where it is not stated, or that of a product."""
    match expression:
        case PropertyOf(property=iri) if iri in vocabulary.properties:
            type_ = vocabulary.properties[iri].type
            return type_.dimension if isinstance(type_, NumberType) else None
        case Arithmetic(operator="+" | "-", left=left, right=right):
            found = _dimension_of(left, vocabulary) or _dimension_of(right, vocabulary)
            return found if found != "Temperature" else None
        case Aggregate(function="sum" | "min" | "max" | "mean", value=value):
            return _dimension_of(value, vocabulary)
    return None


def format_relation(subject: str, relation: str, object_: str, holds: bool = True) -> str:
    """Return `subject relation object`, the relation by its local name; negated unless it holds."""
    return f"{'' if holds else 'not '}{subject} {local_name(relation)} {object_}"


def format_property(owner: str, property_: str, value: str | None) -> str:
    """Return `owner.property == value`, the property by its local name; `not owner has property` if value is None."""
    name = local_name(property_)
    return f"not {owner} has {name}" if value is None else f"{owner}.{name} == {value}"


def format_class(name: str, cls: str, holds: bool = True) -> str:
    """Return `name is cls`, negated unless it holds."""
    return f"{'' if holds else 'not '}{name} is {cls}"


def format_all(parts: Iterable[str]) -> str:
    """Return the conjunction of the parts; `true` if there are no parts."""
    return " and ".join(parts) or "true"


def format_any(parts: Iterable[str]) -> str:
    """Return the disjunction of the parts; `false` if there are no parts."""
    return " or ".join(parts) or "false"


def format_quantified(word: str, variable: str, cls: str, body: str) -> str:
    """Return the quantified condition; `word` is `exists` or `forall`."""
    return f"{word} {variable}: {cls} ({body})"


def format_literal(value: bool | int | float | str) -> str:
    """Return a constant as plain text."""
    match value:
        case bool():
            return "true" if value else "false"
        case int() | float():
            return f"{value:.12g}"
        case str():
            return value
        case _:
            assert_never(value)


def format_expression(expression: Expression, vocabulary: Vocabulary) -> str:
    """Return the expression in the syntax of the language, with only the parentheses that it needs."""
    match expression:
        case Literal(value=str() as text):
            return f'"{text}"'
        case Literal(value=value):
            return format_literal(value)
        case Variable(name=name):
            return name
        case Individual(iri=iri):
            return value_name(iri) if iri in vocabulary.enumerated else vocabulary.short(iri)
        case PropertyOf(of=of, property=iri):
            return f"{format_expression(of, vocabulary)}.{local_name(iri)}"
        case Arithmetic(operator=operator, left=left, right=right):
            sides = (_operand(*each, operator, vocabulary) for each in ((left, right), (right, left)))
            return f" {operator} ".join(sides)
        case Aggregate():
            return _format_aggregate(expression, vocabulary)
        case ListValue(items=items):
            return f"[{', '.join(format_expression(each, vocabulary) for each in items)}]"
        case Message(text=text):
            return f'"{text}"'
        case Invoke(function=function, arguments=arguments):
            return f"{function}({', '.join(format_expression(each, vocabulary) for each in arguments)})"
        case _:
            assert_never(expression)


def _format_aggregate(aggregate: Aggregate, vocabulary: Vocabulary) -> str:
    where = "" if aggregate.where == And(()) else f" where {format_condition(aggregate.where, vocabulary)}"
    members = f"{aggregate.variable}: {vocabulary.short(aggregate.cls)}{where}"
    value = format_expression(aggregate.value, vocabulary)
    if aggregate.function == "ordered":
        return members if isinstance(aggregate.value, Literal) else f"{members} by {value}"
    return f"{aggregate.function}({members}{'' if aggregate.function == 'count' else f', {value}'})"


def _operand(expression: Expression, other: Expression, operator: str, vocabulary: Vocabulary) -> str:
    if isinstance(expression, Arithmetic):
        return f"({format_expression(expression, vocabulary)})"
    if operator in "+-":
        return _format_side(expression, other, vocabulary)
    return format_expression(expression, vocabulary)


def format_each(effect: ForEach, vocabulary: Vocabulary) -> str:
    """Return an effect on each individual that fulfils a condition, as a postcondition states it."""
    wanted = format_condition(wanted_by(effect.effect), vocabulary)
    when = "" if effect.when == And(()) else f" when {format_condition(effect.when, vocabulary)}"
    return format_quantified("forall", effect.variable, vocabulary.short(effect.cls), wanted + when)


def _nested(condition: Condition, vocabulary: Vocabulary) -> str:
    text = format_condition(condition, vocabulary)
    return f"({text})" if isinstance(condition, And | Or | Not) else text


def _term(term: Term, vocabulary: Vocabulary) -> str:
    return "_" if isinstance(term, Anything) else format_expression(term, vocabulary)
