"""Remembers what was made of a value by its identity: equality would take `true` for 1 and cost a hash each time."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, TypeVar

K = TypeVar("K")
V = TypeVar("V")

LIMIT = 4096


class IdentityCache(Generic[K, V]):
    """A function that is called once per object; it forgets everything when it knows more than LIMIT objects."""

    def __init__(self, make: Callable[[K], V]) -> None:
        self._make = make
        self._made: dict[int, tuple[K, V]] = {}

    def __call__(self, item: K) -> V:
        """Return what was made of the object, which is kept alive so that its identity stays its own."""
        known = self._made.get(id(item))
        if known is not None:
            return known[1]
        if len(self._made) >= LIMIT:
            self._made.clear()
        made = self._make(item)
        self._made[id(item)] = item, made
        return made
