"""Values of functional relations in conditions: `x.at` is the one thing that `x at _` holds of."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from msgspec.structs import replace

from skillc_compiler.program.expressions import TypedCondition, TypedExpression
from skillc_compiler.program.types import UNKNOWN, Thing, Type, fits
from skillc_compiler.resolve.scope import FileContext, Scope
from skillc_dsl.source import Span
from skillc_model.conditions import (
    Aggregate,
    And,
    Anything,
    Arithmetic,
    Exists,
    Expression,
    Holds,
    Individual,
    Invoke,
    ListValue,
    Not,
    PropertyOf,
    Term,
    Variable,
)
from skillc_rdf.vocabulary.types import THING, RelationTerm, Vocabulary, local_name


def type_of_link(vocabulary: Vocabulary, relation: RelationTerm, of: Type) -> Type:
    """Return the type of what a functional relation of a thing leads to; one between unknown classes is erroneous."""
    if not relation.signatures:
        return UNKNOWN
    ranges = {each.range for each in relation.signatures if fits(vocabulary, of, Thing(each.domain))}
    return Thing(ranges.pop() if len(ranges) == 1 else None)


def is_link(context: FileContext, value: TypedExpression) -> bool:
    """Whether a value is that of a functional relation; not if it is of an erroneous expression."""
    if not isinstance(value.meaning, PropertyOf) or value.meaning.property not in context.vocabulary.relations:
        return False
    return _is_term(value.parts[0]) or is_link(context, value.parts[0])


def say_of(
    context: FileContext,
    scope: Scope,
    values: Sequence[TypedExpression],
    make: Callable[[Sequence[TypedExpression]], TypedCondition],
) -> TypedCondition:
    """Return a condition of values in which values of relations stand: that there are such, and that it holds then."""
    inside = [each for value in values for each in _operands(value) if is_link(context, each)]
    if not inside:
        return make(values)
    link = inside[-1]  # has none in it: what is in a value comes after it
    thing = TypedExpression(Variable(_choose_name(link, scope)), link.type, link.span)
    return _exists(link, thing, say_of(context, scope, [_replace(each, link, thing) for each in values], make))


def compare_links(
    context: FileContext, scope: Scope, left: TypedExpression, right: TypedExpression, equal: bool, span: Span
) -> TypedCondition | None:
    """Return the comparison of a value of a relation with a thing, or of two such values; None for other values.

    Where there is no such value, both the comparison and its opposite are false.
    """
    link, other = (left, right) if is_link(context, left) else (right, left)
    if not is_link(context, link) or not (is_link(context, other) or _is_term(other)):
        return None

    def hold(things: Sequence[TypedExpression]) -> TypedCondition:
        same = _holds(link, things, span)
        return same if equal else _is_other(link, things[0], same)

    return say_of(context, scope, (link.parts[0], other), hold)


def _is_other(link: TypedExpression, of: TypedExpression, same: TypedCondition) -> TypedCondition:
    """Return that the relation leads to something, and not to that of which `same` is the condition.

    The former is no part of its own: nobody wrote it.
    """
    assert isinstance(link.meaning, PropertyOf)
    unequal = TypedCondition(Not(same.meaning), same.span, parts=(same,))
    some = Holds(_as_term(of), link.meaning.property, Anything())
    return TypedCondition(And((some, unequal.meaning)), same.span, parts=(unequal,))


def _exists(link: TypedExpression, thing: TypedExpression, body: TypedCondition) -> TypedCondition:
    """Return that there is something to which the relation leads, of which the body holds."""
    assert isinstance(thing.meaning, Variable)
    parts = (_holds(link, (link.parts[0], thing), link.span), body)
    both = TypedCondition(And(tuple(part.meaning for part in parts)), link.span, parts=parts)
    cls = link.type.cls if isinstance(link.type, Thing) and link.type.cls else THING
    return TypedCondition(Exists(thing.meaning.name, cls, both.meaning), body.span, parts=(both,))


def _operands(value: TypedExpression) -> Iterator[TypedExpression]:
    """Yield an expression and its operands, but not what is computed of each individual of a class."""
    yield value
    if not isinstance(value.meaning, Aggregate):
        for part in value.parts:
            yield from _operands(part)


def _replace(value: TypedExpression, link: TypedExpression, thing: TypedExpression) -> TypedExpression:
    """Return the value with `thing` in place of that of the relation."""
    if value.meaning == link.meaning:
        return thing
    if isinstance(value.meaning, Aggregate):
        return value
    parts = tuple(_replace(part, link, thing) for part in value.parts)
    inner = [part.meaning for part in parts]
    match value.meaning:
        case PropertyOf(property=iri):
            meaning: Expression = PropertyOf(inner[0], iri)
        case Arithmetic(operator=operator):
            meaning = Arithmetic(operator, *inner)
        case Invoke(function=name):
            meaning = Invoke(name, tuple(inner))
        case ListValue():
            meaning = ListValue(tuple(inner))
        case _:
            meaning = value.meaning
    return replace(value, meaning=meaning, parts=parts)


def _holds(link: TypedExpression, things: Sequence[TypedExpression], span: Span) -> TypedCondition:
    assert isinstance(link.meaning, PropertyOf)
    subject, object_ = things
    meaning = Holds(_as_term(subject), link.meaning.property, _as_term(object_))
    return TypedCondition(meaning, span, (subject, object_))


def _choose_name(link: TypedExpression, scope: Scope) -> str:
    assert isinstance(link.meaning, PropertyOf)
    name = f"{local_name(link.meaning.property)}_{link.span.line}_{link.span.end_column}"
    while name in scope.variables:
        name += "_"
    return name


def _is_term(value: TypedExpression) -> bool:
    return isinstance(value.meaning, Variable | Individual)


def _as_term(value: TypedExpression) -> Term:
    assert isinstance(value.meaning, Variable | Individual)
    return value.meaning
