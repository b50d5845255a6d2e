"""Moves quantifiers inwards, so that a part of a condition is decided as soon as its variables have values.

`exists a (exists b (P(b) and R(a, b) and Q(c, a)))` becomes `exists a (Q(c, a) and exists b (R(a, b) and P(b)))`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Generic, TypeVar

import msgspec

P = TypeVar("P")


class Nesting(msgspec.Struct, Generic[P], frozen=True):
    """Parts of a conjunction, and how variables are quantified and parts joined."""

    parts: Sequence[tuple[P, frozenset[str]]]
    quantify: Callable[[str, P], P]
    join: Callable[[Sequence[P]], P]

    def nest(self, left: Sequence[str]) -> P:
        """Return the conjunction of the parts, with the variables `left` quantified as far inside as possible."""
        names = frozenset(left)
        bound = [part for part, about in self.parts if not about & names]
        return self.join([*bound, *(self._within(group).bind(group) for group in self._connected(left))])

    def bind(self, group: Sequence[str]) -> P:
        """Quantify connected variables, first the one that most parts are then about alone."""
        names = frozenset(group)

        def decided(variable: str) -> int:
            return sum(about & names == {variable} for _, about in self.parts)

        first = max(group, key=decided)  # the first of several in the order of the text
        return self.quantify(first, self.nest([each for each in group if each != first]))

    def _within(self, group: Sequence[str]) -> Nesting[P]:
        return msgspec.structs.replace(self, parts=[each for each in self.parts if not each[1].isdisjoint(group)])

    def _connected(self, left: Sequence[str]) -> list[list[str]]:
        groups = [[each] for each in left]
        for _, about in self.parts:
            touched = [group for group in groups if not about.isdisjoint(group)]
            if len(touched) > 1:
                joined = [each for each in left if any(each in group for group in touched)]
                groups = [group for group in groups if group not in touched] + [joined]
        return groups
