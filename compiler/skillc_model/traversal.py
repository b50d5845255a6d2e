"""Traversal of conditions, expressions and bodies: their parts, calls and free variables."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, lru_cache

import msgspec

from skillc_model.conditions import Aggregate, And, Condition, Effect, Exists, Expression, Forall, ForEach, Variable
from skillc_model.tree import Call

_PLAIN = (str, int, float, bool)
"""The types of values that hold no structs."""


def walk(item: msgspec.Struct) -> Iterator[msgspec.Struct]:
    """Yield a condition or expression and everything inside it."""
    todo = [item]
    while todo:
        here = todo.pop()
        yield here
        todo += reversed(children(here))


def children(item: msgspec.Struct) -> list[msgspec.Struct]:
    """Return the structs directly inside a struct (conditions, expressions, nodes, ..), in order."""
    found: list[msgspec.Struct] = []
    for name in compound_fields(type(item)):
        value = getattr(item, name)
        if isinstance(value, msgspec.Struct):
            found.append(value)
        elif isinstance(value, tuple | dict):
            parts = value if isinstance(value, tuple) else value.values()
            found += [part for part in parts if isinstance(part, msgspec.Struct)]
    return found


@cache
def compound_fields(kind: type[msgspec.Struct]) -> tuple[str, ...]:
    """Return the fields of a type of structs that may hold structs."""
    return tuple(each.name for each in msgspec.structs.fields(kind) if each.type not in _PLAIN)


def conjuncts(condition: Condition) -> Iterator[Condition]:
    """Yield the parts of a conjunction, nested ones included, or the condition itself if it is not a conjunction."""
    if isinstance(condition, And):
        for part in condition.parts:
            yield from conjuncts(part)
    else:
        yield condition


def find_calls(item: msgspec.Struct) -> Iterator[Call]:
    """Yield the calls of skills in a body, in the order of the text."""
    return (each for each in walk(item) if isinstance(each, Call))


def is_nested_deeper(item: msgspec.Struct, most: int) -> bool:
    """Whether a condition, an expression or a call is nested more than `most` levels deep."""
    level = [item]
    for _ in range(most + 1):
        level = [part for each in level for part in children(each)]
    return bool(level)


@lru_cache(maxsize=4096)
def free_variables(item: Condition | Expression) -> frozenset[str]:
    """Return the names of the free variables."""
    return frozenset(_free(item))


def free_variables_in_order(item: Condition | Effect | Expression) -> tuple[str, ...]:
    """Return the names of the free variables in the order in which they first occur."""
    return tuple(dict.fromkeys(_free(item)))


def _free(item: msgspec.Struct) -> Iterator[str]:
    if isinstance(item, Variable):
        yield item.name
    bound = item.variable if isinstance(item, Exists | Forall | ForEach | Aggregate) else None
    yield from (name for part in children(item) for name in _free(part) if name != bound)
