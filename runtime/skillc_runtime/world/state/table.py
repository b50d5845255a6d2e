"""An immutable map whose versions share their bulk."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import isqrt
from typing import Generic, TypeVar

K = TypeVar("K")
V = TypeVar("V")


class Table(Generic[K, V]):
    """A map in two layers: a large one shared with earlier versions and a small one with what changed since.

    The value `empty` stands for "no entry". The small layer is merged when it outgrows the root of the large one,
    so a new version costs a few microseconds however large the map is, and a lookup two dictionary probes.
    """

    __slots__ = ("_base", "_empty", "_recent")

    def __init__(self, empty: V, base: dict[K, V] | None = None, recent: dict[K, V] | None = None) -> None:
        self._empty = empty
        self._base: dict[K, V] = {} if base is None else base
        self._recent: dict[K, V] = {} if recent is None else recent

    def get(self, key: K) -> V:
        """Return the entry, `empty` where there is none."""
        recent = self._recent
        if key in recent:
            return recent[key]
        return self._base.get(key, self._empty)

    def __bool__(self) -> bool:
        """Whether there may be an entry."""
        return bool(self._base or self._recent)

    def items(self) -> Iterator[tuple[K, V]]:
        """Yield the entries, in no particular order."""
        recent, empty = self._recent, self._empty
        if not recent:
            yield from self._base.items()
            return
        yield from (entry for entry in self._base.items() if entry[0] not in recent)
        yield from (entry for entry in recent.items() if entry[1] is not empty)

    def updated(self, changes: Mapping[K, V]) -> Table[K, V]:
        """Return the next version; this one stays as it is."""
        recent = {**self._recent, **changes}
        if len(recent) <= 16 + 2 * isqrt(len(self._base)):
            return Table(self._empty, self._base, recent)
        merged = {**self._base, **recent}
        return Table(self._empty, {key: value for key, value in merged.items() if value is not self._empty})
