"""What has to hold before a number is changed: it is known, and stays in its range."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.logic.effects import NoEffect, effects_of
from skillc_compiler.program.expressions import TypedCondition
from skillc_model.conditions import (
    Adjust,
    And,
    Arithmetic,
    Compare,
    Condition,
    Expression,
    Forall,
    HasProperty,
    Literal,
    Not,
    Or,
    PropertyOf,
)
from skillc_model.rewriting import constant_number
from skillc_model.traversal import walk
from skillc_rdf.vocabulary.types import Bounds


def needs_of_changes(post: TypedCondition) -> tuple[Condition, ...]:
    """Return what has to hold before the changes of numbers of a postcondition, one condition a change."""
    return tuple(_needs(post))


def _needs(post: TypedCondition) -> Iterator[Condition]:
    if post.conditional is not None:
        body, when = post.parts
        scope = post.conditional
        for need in _needs(body):
            yield Forall(scope.variable, scope.cls, Or((Not(when.meaning), need)))
    elif isinstance(post.meaning, Forall):
        for need in _needs(post.parts[0]):
            yield Forall(post.meaning.variable, post.meaning.cls, need)
    elif isinstance(post.meaning, And) and post.change is None:
        yield from (need for part in post.parts for need in _needs(part))
    for effect in effects_of(post) if post.change is not None else ():
        if not isinstance(effect, NoEffect) and isinstance(effect, Adjust):
            found = tuple(_of_one(effect, post.change.bounds if post.change else None))
            if found:
                yield found[0] if len(found) == 1 else And(found)


def _of_one(effect: Adjust, bounds: Bounds | None) -> Iterator[Condition]:
    number = PropertyOf(effect.subject, effect.property)
    ends = [end for end in (effect.low, effect.high) if end is not None]
    if any(number in walk(end) for end in ends):
        yield HasProperty(effect.subject, effect.property)
    least, greatest = (bounds.least, bounds.greatest) if bounds is not None else (None, None)
    if least is not None and effect.low is not None and not _is_kept(effect.low, number, "+"):
        yield Compare(effect.low, ">=", Literal(least))
    if greatest is not None and effect.high is not None and not _is_kept(effect.high, number, "-"):
        yield Compare(effect.high, "<=", Literal(greatest))


def _is_kept(value: Expression, number: PropertyOf, operator: str) -> bool:
    """Whether a value is a constant, or the number before and a constant that leads away from a bound."""
    match value:
        case Arithmetic(operator=sign, left=left, right=Literal(value=int() | float() as by)) if left == number:
            return sign == operator and by >= 0
    return constant_number(value) is not None
