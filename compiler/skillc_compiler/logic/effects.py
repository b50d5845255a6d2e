"""The effects of a postcondition."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from skillc_compiler.program.expressions import EffectScope, NumberChange, TypedCondition, TypedExpression
from skillc_compiler.program.types import Thing
from skillc_dsl.source import Span
from skillc_model.conditions import (
    Adjust,
    And,
    Anything,
    Arithmetic,
    Assert,
    Assign,
    Compare,
    Condition,
    Effect,
    Exists,
    Expression,
    Forall,
    ForEach,
    Holds,
    Individual,
    Literal,
    Not,
    PropertyOf,
    Retract,
    Variable,
)
from skillc_model.rewriting import fold
from skillc_model.traversal import walk


class NoEffect(msgspec.Struct, frozen=True):
    """A part of a postcondition that does not determine the world afterwards, and why.

    It would with `operator` in the place of what stands between its two spans, or with a parameter in the place of
    `reads`, a value of a functional relation.
    """

    span: Span
    reason: str
    reads: TypedExpression | None = None
    operator: str = ""
    around: tuple[Span, Span] | None = None


def effects_of(post: TypedCondition) -> tuple[Effect | NoEffect, ...]:
    """Return the effects of a postcondition, a conjunction of literals; any other part gives a NoEffect."""
    match post.meaning:
        case _ if post.change is not None:
            return (_adjust(post, post.change),)
        case _ if post.conditional is not None:
            body, when = post.parts
            return tuple(_for_each(body, post.conditional, when.meaning))
        case Forall(variable=variable, cls=cls):
            return tuple(_for_each(post.parts[0], EffectScope(variable, cls), And(())))
        case And():
            return tuple(effect for part in post.parts for effect in effects_of(part))
        case Not():
            return (_negative_effect(post, post.parts[0]),)
        case _:
            return (_positive_effect(post),)


def _adjust(post: TypedCondition, change: NumberChange) -> Effect | NoEffect:
    match change.of.meaning:
        case PropertyOf(of=Variable() | Individual() as of, property=name) as number:
            low, high = (_value_after(number, change.operator, each) for each in (change.low, change.high))
            return Adjust(of, name, high, low) if change.operator == "-=" else Adjust(of, name, low, high)
    return NoEffect(change.of.span, "only a number that is a property of a parameter or an individual can be changed")


def _value_after(number: PropertyOf, operator: str, amount: TypedExpression | None) -> Expression | None:
    if amount is None:
        return None
    if operator == ":=":
        return fold(amount.meaning)
    return fold(Arithmetic("+" if operator == "+=" else "-", number, amount.meaning))


def _for_each(body: TypedCondition, scope: EffectScope, when: Condition) -> Iterator[Effect | NoEffect]:
    for effect in effects_of(body):
        if isinstance(effect, ForEach):
            yield NoEffect(body.span, "it is about all of several classes at once")
        elif isinstance(effect, NoEffect):
            yield effect
        else:
            yield ForEach(scope.variable, scope.cls, when, effect)


def _positive_effect(post: TypedCondition) -> Effect | NoEffect:
    match post.meaning:
        case Holds(subject=Anything()) | Holds(object=Anything()):
            return NoEffect(post.span, "it does not say which individual is related")
        case Holds(subject=subject, relation=relation, object=object_):
            assert not isinstance(subject, Anything) and not isinstance(object_, Anything)
            return Assert(subject, relation, object_)
        case Compare(left=PropertyOf(of=of, property=name), operator="==", right=right):
            return _assign(post, of, name, right)
        case Compare(left=left, operator="==", right=PropertyOf(of=of, property=name)):
            return _assign(post, of, name, left)
        case Compare(left=PropertyOf(of=of, property=name), operator="!=", right=Literal(value=bool(value))):
            return _assign(post, of, name, Literal(not value))
        case Compare():
            return NoEffect(post.span, "it leaves open which value the property has")
        case Exists(variable=name, cls=cls, body=And(parts=(Holds(subject=subject, relation=iri), *_))) if _reads(post):
            assert isinstance(subject, Variable | Individual), "what a value is of is a thing"
            read = TypedExpression(PropertyOf(subject, iri), Thing(cls), post.parts[0].parts[0].span)
            return NoEffect(post.span, "it reads a value of a relation, which may have none", read)
    return NoEffect(post.span, "only relations and `property == value` can be made true")


def _reads(post: TypedCondition) -> bool:
    """Whether nobody wrote the `exists` of a condition: it says that a value of a relation, such as `x.at`, exists."""
    link = post.parts[0].parts[0]
    return len(link.values) == 2 and link.span == link.values[1].span


def _negative_effect(whole: TypedCondition, body: TypedCondition) -> Effect | NoEffect:
    match body.meaning:
        case Holds(subject=subject, relation=relation, object=object_):
            return Retract(subject, relation, object_)
        case Compare(left=PropertyOf(of=of, property=name), operator="==", right=Literal(value=bool(value))):
            return _assign(whole, of, name, Literal(not value))
        case Compare(left=Literal(value=bool(value)), operator="==", right=PropertyOf(of=of, property=name)):
            return _assign(whole, of, name, Literal(not value))
    return NoEffect(whole.span, "only relations and truth values can be made false")


def _assign(post: TypedCondition, of: Expression, name: str, value: Expression) -> Effect | NoEffect:
    if any(part == PropertyOf(of, name) for part in walk(value) if part is not value):
        reason = "it reads the value that it sets, which would have to differ from itself"
        return NoEffect(post.span, reason, None, *_written_as_change(post, of, name))
    if isinstance(of, Variable | Individual):
        return Assign(of, name, value)
    return NoEffect(post.span, "only a parameter's or an individual's property can be set")


def _written_as_change(post: TypedCondition, of: Expression, name: str) -> tuple[str, tuple[Span, Span]] | tuple[()]:
    """Return the operator of the change that `x.p == x.p - amount` means, and what stands around it."""
    left, right = post.values
    match right.meaning:
        case Arithmetic(operator="+" | "-" as operator, left=before) if before == left.meaning == PropertyOf(of, name):
            return f"{operator}=", (left.span, right.parts[1].span)
    return ()
