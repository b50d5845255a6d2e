"""Rewriting of conditions and expressions: substitution, deciding `given`, constant folding."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from itertools import count
from operator import is_
from typing import Any, TypeVar, assert_never

import msgspec

from skillc_model.conditions import (
    Adjust,
    Aggregate,
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
    Retract,
    Same,
    Term,
    Variable,
)
from skillc_model.traversal import children, compound_fields, free_variables, walk
from skillc_model.tree import Node

S = TypeVar("S", bound=msgspec.Struct)
T = TypeVar("T", bound=Condition | Effect | Expression | Term | Node)
ALWAYS, NEVER = And(()), Or(())
_PLACES_OF_INDIVIDUALS: Mapping[type, tuple[str, ...]] = {
    **dict.fromkeys((Holds, Assert, Retract), ("subject", "object")),
    Same: ("left", "right"),
    **dict.fromkeys((HasProperty, IsA, Assign, Adjust), ("subject",)),
}


def map_children(item: S, change: Callable[[Any], msgspec.Struct]) -> S:
    """Return the struct with `change` applied to each struct directly inside it; the same object if nothing changes."""
    changes: dict[str, object] = {}
    for name in compound_fields(type(item)):
        value = getattr(item, name)
        new = _map_value(value, change)
        if new is not value:
            changes[name] = new
    return msgspec.structs.replace(item, **changes) if changes else item


def _map_value(value: object, change: Callable[[Any], msgspec.Struct]) -> object:
    """Return the value of a field with `change` applied to the structs in it; the same object if nothing changes."""
    if isinstance(value, msgspec.Struct):
        return change(value)
    if isinstance(value, tuple):
        parts = tuple(_map_value(each, change) for each in value)
        return value if all(map(is_, parts, value)) else parts
    if isinstance(value, dict):
        entries = {key: _map_value(each, change) for key, each in value.items()}
        return value if all(map(is_, entries.values(), value.values())) else entries
    return value


def contains_kind(item: Condition, *kinds: type[msgspec.Struct]) -> bool:
    """Whether a struct of one of these types occurs in the condition."""
    return any(isinstance(each, kinds) for each in walk(item))


def substitute(item: T, values: Mapping[str, Expression]) -> T:
    """Return the condition, effect, expression, term or body with the variables replaced; capture is avoided.

    A value in a place that takes only individuals is replaced by an unknown individual; the author's type error is
    reported elsewhere.
    """
    if isinstance(item, Variable):
        return values.get(item.name, item)  # type: ignore[return-value]
    if not values or not compound_fields(type(item)):  # type: ignore[arg-type]
        return item
    if isinstance(item, Exists | Forall | ForEach | Aggregate):
        values = {name: value for name, value in values.items() if name != item.variable}
        item = _without_capture(item, values)
    changed = map_children(item, lambda part: substitute(part, values))
    for name in _PLACES_OF_INDIVIDUALS.get(type(item), ()):
        if not isinstance(getattr(changed, name), Variable | Individual | Anything):
            was = getattr(item, name)
            unknown = Variable(f"{was.name}?" if isinstance(was, Variable) else "?")
            changed = msgspec.structs.replace(changed, **{name: unknown})
    return changed


@lru_cache(maxsize=65536)
def substitute_one(item: Condition, name: str, thing: Variable | Individual) -> Condition:
    """Return the condition with one variable replaced by an individual, as `substitute` does."""
    return substitute(item, {name: thing})


def _without_capture(item: T, values: Mapping[str, Expression]) -> T:
    """Return the quantifier, its variable renamed if it would capture a free variable of the expressions."""
    assert isinstance(item, Exists | Forall | ForEach | Aggregate)
    coming = {name for key in free_variables(item) if key in values for name in free_variables(values[key])}
    if item.variable not in coming:
        return item
    taken = coming.union(*map(free_variables, children(item)))
    new = next(name for number in count(2) if (name := f"{item.variable}_{number}") not in taken)
    renamed = map_children(item, lambda part: substitute(part, {item.variable: Variable(new)}))
    return msgspec.structs.replace(renamed, variable=new)


def decide_given(condition: Condition, given: Mapping[str, bool]) -> Condition:
    """Return the condition with every `given` replaced by its value, simplified."""
    match condition:
        case Given(parameter=name):
            return ALWAYS if given[name] else NEVER
        case Not(body=body):
            inner = decide_given(body, given)
            return NEVER if inner == ALWAYS else ALWAYS if inner == NEVER else Not(inner)
        case And(parts=parts):
            kept = tuple(each for each in (decide_given(part, given) for part in parts) if each != ALWAYS)
            return NEVER if NEVER in kept else kept[0] if len(kept) == 1 else And(kept)
        case Or(parts=parts):
            kept = tuple(each for each in (decide_given(part, given) for part in parts) if each != NEVER)
            return ALWAYS if ALWAYS in kept else kept[0] if len(kept) == 1 else Or(kept)
        case Exists() | Forall():
            return msgspec.structs.replace(condition, body=decide_given(condition.body, given))
        case Holds() | Compare() | Same() | HasProperty() | IsA():
            return condition
        case _:
            assert_never(condition)


def fold(item: T) -> T:
    """Return a condition or expression with constant arithmetic evaluated, except divisions by zero."""
    folded = map_children(item, fold)
    constant = _constant(folded) if isinstance(folded, Arithmetic) else None
    return folded if constant is None else constant  # type: ignore[return-value]


def _constant(folded: Arithmetic) -> Literal | None:
    """Return the value of constant arithmetic, whole if its operands are; None if it has none."""
    value = constant_number(folded)
    if value is None:
        return None
    sides = (folded.left, folded.right)
    whole = folded.operator != "/" and all(isinstance(side, Literal) and isinstance(side.value, int) for side in sides)
    return Literal(int(value) if whole else value)


def constant_number(expression: Expression | None) -> float | None:
    """Return the value of a constant numeric expression; None if it is not constant or divides by zero."""
    match expression:
        case Literal(value=bool() | str()):
            return None
        case Literal(value=value):
            return float(value)
        case Arithmetic(operator=operator, left=left, right=right):
            a, b = constant_number(left), constant_number(right)
            return None if a is None or b is None else _applied(operator, a, b)
        case Variable() | Individual() | PropertyOf() | Invoke() | ListValue() | Aggregate() | Message() | None:
            return None
        case _:
            assert_never(expression)


def _applied(operator: str, a: float, b: float) -> float | None:
    if operator == "/":
        return a / b if b else None
    return {"+": a + b, "-": a - b, "*": a * b}[operator]


def is_plain_fact(condition: Condition) -> bool:
    """Whether the condition is a relation, identity or class test on variables only, expressible as one atom."""
    return isinstance(condition, Holds | Same | IsA) and not contains_kind(condition, Individual, Anything)
