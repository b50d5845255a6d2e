"""Immutable maps, sets and pair indexes whose versions share unchanged parts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set
from math import isqrt
from typing import Generic, TypeVar

import msgspec

K = TypeVar("K")
V = TypeVar("V")


class VersionedMap(Generic[K, V]):
    """A map in two layers: a large one shared with earlier versions and a small one with later changes.

    The value `empty` means "no entry". The small layer is merged when it outgrows the square root of the large one, so
    a new version costs a few microseconds for a map of any size, and a lookup costs two dictionary probes.
    """

    __slots__ = ("_base", "_empty", "_recent")

    def __init__(self, empty: V, base: dict[K, V] | None = None, recent: dict[K, V] | None = None) -> None:
        self._empty = empty
        self._base: dict[K, V] = {} if base is None else base
        self._recent: dict[K, V] = {} if recent is None else recent

    def get(self, key: K) -> V:
        """Return the entry, or `empty`."""
        recent = self._recent
        if key in recent:
            return recent[key]
        return self._base.get(key, self._empty)

    def __bool__(self) -> bool:
        """Whether there may be an entry."""
        return bool(self._base or self._recent)

    def items(self) -> Iterator[tuple[K, V]]:
        """Yield the entries, in no particular order."""
        recent = self._recent
        if not recent:
            yield from self._base.items()
            return
        yield from (entry for entry in self._base.items() if entry[0] not in recent)
        yield from (entry for entry in recent.items() if self._is_entry(entry[1]))

    def with_changes(self, changes: Mapping[K, V]) -> VersionedMap[K, V]:
        """Return the next version; this one does not change."""
        recent = {**self._recent, **changes}
        if len(recent) <= 16 + 2 * isqrt(len(self._base)):
            return VersionedMap(self._empty, self._base, recent)
        merged = {**self._base, **recent}
        return VersionedMap(self._empty, {key: value for key, value in merged.items() if self._is_entry(value)})

    def _is_entry(self, value: V) -> bool:
        # A set that another process sent is empty without being `empty`; an array cannot be compared.
        return value is not self._empty and not (isinstance(value, frozenset) and not value)


class VersionedSet:
    """A set of individuals in two layers: a large shared set and later additions and removals.

    The layers are merged when all members are asked for, and after about as many writes as the square root of the size.
    """

    __slots__ = ("_all", "_base", "_recent")

    def __init__(self, base: frozenset[str] = frozenset(), recent: Mapping[str, bool] | None = None) -> None:
        self._base = base
        self._recent = recent or {}
        self._all = None if recent else base

    def members(self) -> frozenset[str]:
        """Return the members."""
        if self._all is None:
            present = {individual for individual, is_in in self._recent.items() if is_in}
            self._all = self._base.difference(self._recent) | present
        return self._all

    def with_changes(self, changes: Mapping[str, bool]) -> VersionedSet:
        """Return the next version, where each individual is a member or not; this one does not change."""
        if self._all is not None:
            return VersionedSet(self._all, changes)
        recent = {**self._recent, **changes}
        if len(recent) <= 16 + 2 * isqrt(len(self._base)):
            return VersionedSet(self._base, recent)
        return VersionedSet(VersionedSet(self._base, recent).members())


EMPTY: frozenset[str] = frozenset()


def _no_entries() -> VersionedMap[str, frozenset[str]]:
    return VersionedMap(EMPTY)


class PairIndex(msgspec.Struct, frozen=True):
    """The pairs (subject, object) of one relation, indexed both ways; immutable."""

    forward: VersionedMap[str, frozenset[str]]
    backward: VersionedMap[str, frozenset[str]]

    @staticmethod
    def empty() -> PairIndex:
        """Return an index without pairs."""
        return PairIndex(_no_entries(), _no_entries())

    def pairs(self) -> Iterator[tuple[str, str]]:
        """Yield all pairs, in no particular order."""
        for subject, objects in self.forward.items():
            for object_ in objects:
                yield subject, object_


class PairIndexBuilder:
    """Builds the next version of a pair index; copies only the entries that are written."""

    def __init__(self, links: PairIndex) -> None:
        self._links = links
        self._forward: dict[str, set[str]] = {}
        self._backward: dict[str, set[str]] = {}

    def objects(self, subject: str) -> Set[str]:
        """Return the current objects of a subject."""
        return self._forward[subject] if subject in self._forward else self._links.forward.get(subject)

    def subjects(self, object_: str) -> Set[str]:
        """Return the current subjects of an object."""
        return self._backward[object_] if object_ in self._backward else self._links.backward.get(object_)

    def add(self, subject: str, object_: str) -> None:
        """Add a pair."""
        if object_ not in self.objects(subject):
            _writable(self._forward, self._links.forward, subject).add(object_)
            _writable(self._backward, self._links.backward, object_).add(subject)

    def discard(self, subject: str, object_: str) -> None:
        """Remove a pair if it is there."""
        if object_ in self.objects(subject):
            _writable(self._forward, self._links.forward, subject).discard(object_)
            _writable(self._backward, self._links.backward, object_).discard(subject)

    def build(self) -> PairIndex:
        """Return the next version, the same object if nothing was written."""
        if not self._forward:
            return self._links
        return PairIndex(
            self._links.forward.with_changes(_sets(self._forward)),
            self._links.backward.with_changes(_sets(self._backward)),
        )


def _writable(written: dict[str, set[str]], table: VersionedMap[str, frozenset[str]], key: str) -> set[str]:
    if key not in written:
        written[key] = set(table.get(key))
    return written[key]


def _sets(written: dict[str, set[str]]) -> dict[str, frozenset[str]]:
    return {key: frozenset(members) if members else EMPTY for key, members in written.items()}
