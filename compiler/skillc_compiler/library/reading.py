"""Looking into conditions and expressions: what they are made of, which names they leave open."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import lru_cache

import msgspec

from skillc_compiler.library.conditions import (
    Condition,
    Effect,
    Exists,
    Expression,
    Forall,
    Variable,
)


def walk(item: msgspec.Struct) -> Iterator[msgspec.Struct]:
    """Yield a condition or expression and everything inside it."""
    yield item
    for part in _inside(item):
        yield from walk(part)


def is_deeper(item: object, most: int) -> bool:
    """Whether parts of a condition, an expression or a call are inside each other more than so many times."""
    level = [item]
    for _ in range(most + 1):
        structs = [each for each in level if isinstance(each, msgspec.Struct)]
        level = [part for each in structs for name in each.__struct_fields__ for part in _flat(getattr(each, name))]
        if not level:
            return False
    return any(isinstance(each, msgspec.Struct) for each in level)


def _flat(value: object) -> Iterable[object]:
    match value:
        case tuple():
            return value
        case dict():
            return value.values()
        case _:
            return (value,)


@lru_cache(maxsize=4096)
def free_variables(item: Condition | Expression) -> frozenset[str]:
    """Return the variables whose values come from outside."""
    return frozenset(_free(item))


def free_variables_in_order(item: Condition | Effect | Expression) -> tuple[str, ...]:
    """Return the same in the order in which they first occur."""
    return tuple(dict.fromkeys(_free(item)))


def _free(item: msgspec.Struct) -> Iterator[str]:
    if isinstance(item, Variable):
        yield item.name
    bound = item.variable if isinstance(item, Exists | Forall) else None
    yield from (name for part in _inside(item) for name in _free(part) if name != bound)


def _inside(item: msgspec.Struct) -> Iterator[msgspec.Struct]:
    for name in item.__struct_fields__:
        value = getattr(item, name)
        parts = value if isinstance(value, tuple) else (value,)
        yield from (part for part in parts if isinstance(part, msgspec.Struct))
