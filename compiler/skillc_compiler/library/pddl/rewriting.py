"""Rewriting conditions and expressions: values for variables, answers for `given`, constants."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import count
from typing import TypeVar, assert_never

import msgspec

from skillc_compiler.library.conditions import (
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
    Given,
    HasProperty,
    Holds,
    Individual,
    Invoke,
    IsA,
    Literal,
    Not,
    Or,
    PropertyOf,
    Retract,
    Same,
    Term,
    Variable,
)
from skillc_compiler.library.reading import free_variables, walk

T = TypeVar("T", bound=Condition | Effect | Expression | Term)
ALWAYS, NEVER = And(()), Or(())


def has(item: Condition, *kinds: type[msgspec.Struct]) -> bool:
    """Whether anything of these kinds occurs in the condition."""
    return any(isinstance(each, kinds) for each in walk(item))


def replaced(item: T, values: Mapping[str, Expression]) -> T:
    """Return the condition, effect, expression or term with expressions in the place of these variables.

    Where only an individual can stand, the place of a value that is none is taken by an unknown individual: the author
    mixed them up, which is reported where it was written.
    """
    if isinstance(item, Variable):
        return values.get(item.name, item)  # type: ignore[return-value]
    if isinstance(item, Exists | Forall):
        values = {name: value for name, value in values.items() if name != item.variable}
        item = _without_capture(item, values)
    changes = {name: _replaced(getattr(item, name), values) for name in item.__struct_fields__}
    for name in _places_of_individuals(item):
        if not isinstance(changes[name], Variable | Individual | Anything):
            was = getattr(item, name)
            changes[name] = Variable(f"{was.name}?" if isinstance(was, Variable) else "?")
    return msgspec.structs.replace(item, **changes)


def _places_of_individuals(item: Condition | Effect | Expression | Term) -> tuple[str, ...]:
    match item:
        case Holds() | Assert() | Retract():
            return ("subject", "object")
        case Same():
            return ("left", "right")
        case HasProperty() | IsA() | Assign():
            return ("subject",)
        case _:
            return ()


def _without_capture(item: T, values: Mapping[str, Expression]) -> T:
    """Return a quantifier whose variable is none of those that come into it from outside."""
    assert isinstance(item, Exists | Forall)
    coming = {name for key in free_variables(item) if key in values for name in free_variables(values[key])}
    if item.variable not in coming:
        return item
    taken = coming | free_variables(item.body)
    new = next(name for number in count(2) if (name := f"{item.variable}_{number}") not in taken)
    body = replaced(item.body, {item.variable: Variable(new)})
    return msgspec.structs.replace(item, variable=new, body=body)


def _replaced(value: object, values: Mapping[str, Expression]) -> object:
    if isinstance(value, tuple):
        return tuple(_replaced(each, values) for each in value)
    return replaced(value, values) if isinstance(value, msgspec.Struct) else value  # type: ignore[type-var]


def decided(condition: Condition, given: Mapping[str, bool]) -> Condition:
    """Return the condition with every `given` answered and what is then certain taken out."""
    match condition:
        case Given(parameter=name):
            return ALWAYS if given[name] else NEVER
        case Not(body=body):
            inner = decided(body, given)
            return NEVER if inner == ALWAYS else ALWAYS if inner == NEVER else Not(inner)
        case And(parts=parts):
            kept = tuple(each for each in (decided(part, given) for part in parts) if each != ALWAYS)
            return NEVER if NEVER in kept else kept[0] if len(kept) == 1 else And(kept)
        case Or(parts=parts):
            kept = tuple(each for each in (decided(part, given) for part in parts) if each != NEVER)
            return ALWAYS if ALWAYS in kept else kept[0] if len(kept) == 1 else Or(kept)
        case Exists() | Forall():
            return msgspec.structs.replace(condition, body=decided(condition.body, given))
        case Holds() | Compare() | Same() | HasProperty() | IsA():
            return condition
        case _:
            assert_never(condition)


def constant(expression: Expression) -> float | None:
    """Return the value of a number made of constants alone, None when it depends on anything."""
    match expression:
        case Literal(value=bool() | str()):
            return None
        case Literal(value=value):
            return float(value)
        case Arithmetic(operator=operator, left=left, right=right):
            a, b = constant(left), constant(right)
            return None if a is None or b is None else _applied(operator, a, b)
        case Variable() | Individual() | PropertyOf() | Invoke():
            return None
        case _:
            assert_never(expression)


def _applied(operator: str, a: float, b: float) -> float | None:
    if operator == "/":
        return a / b if b else None
    return {"+": a + b, "-": a - b, "*": a * b}[operator]


def is_plain(condition: Condition) -> bool:
    """Whether a fact about variables alone, which a predicate can say: a relation, identity or class."""
    return isinstance(condition, Holds | Same | IsA) and not has(condition, Individual, Anything)
