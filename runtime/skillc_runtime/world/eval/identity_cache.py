"""Caches results by the identity of the argument: by equality, `true` would equal 1, and hashing costs time."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, TypeVar

K = TypeVar("K")
V = TypeVar("V")

LIMIT = 4096


class IdentityCache(Generic[K, V]):
    """A function that is called once per object; the cache is cleared at LIMIT objects."""

    def __init__(self, make: Callable[[K], V]) -> None:
        self._make = make
        self._made: dict[int, tuple[K, V]] = {}

    def __call__(self, item: K) -> V:
        """Return the result for an object; the cache keeps the object alive, so that its identity is not reused."""
        known = self._made.get(id(item))
        if known is not None:
            return known[1]
        if len(self._made) >= LIMIT:
            self._made.clear()
        made = self._make(item)
        self._made[id(item)] = item, made
        return made
