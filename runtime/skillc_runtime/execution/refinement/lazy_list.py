"""A list whose items are computed when they are first asked for, and kept for all who ask later."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Generic, TypeVar

T = TypeVar("T")


class LazyList(Generic[T]):
    """The items of an iterator, each taken from it once; several may go through it at the same time."""

    def __init__(self, items: Iterator[T]) -> None:
        self._items, self._known = items, list[T]()

    def __iter__(self) -> Iterator[T]:
        place = 0
        while True:
            if place == len(self._known):
                try:
                    self._known.append(next(self._items))
                except StopIteration:
                    return
            yield self._known[place]
            place += 1
