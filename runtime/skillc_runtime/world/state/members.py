"""The individuals of one class, of which the next version costs what is changed, however many there are."""

from __future__ import annotations

from collections.abc import Mapping
from math import isqrt


class Members:
    """An immutable set: a large one, and whether individuals are in it of which that was written since.

    It is put together when somebody asks for all of it, and after about as many writes as the square root of its size.
    """

    __slots__ = ("_all", "_base", "_recent")

    def __init__(self, base: frozenset[str] = frozenset(), recent: Mapping[str, bool] | None = None) -> None:
        self._base = base
        self._recent = recent or {}
        self._all = None if recent else base

    def all(self) -> frozenset[str]:
        """Return the members."""
        if self._all is None:
            present = {individual for individual, is_in in self._recent.items() if is_in}
            self._all = self._base.difference(self._recent) | present
        return self._all

    def updated(self, changes: Mapping[str, bool]) -> Members:
        """Return the next version with individuals that are in it now, or are not; this one stays as it is."""
        if self._all is not None:
            return Members(self._all, changes)
        recent = {**self._recent, **changes}
        if len(recent) <= 16 + 2 * isqrt(len(self._base)):
            return Members(self._base, recent)
        return Members(Members(self._base, recent).all())
