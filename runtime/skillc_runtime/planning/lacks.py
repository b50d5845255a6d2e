"""What a planning problem lacks so that a formula can hold, and the ways to make it hold, by what they lack."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import product
from typing import TypeAlias

import msgspec

from skillc_model.pddl.domain import Action
from skillc_model.pddl.formulas import Atom

MAX_WAYS = 40
"""How many ways to make one formula true are considered, those that lack the least first."""


class Lack(msgspec.Struct, frozen=True):
    """An atom that should be true (`holds`) or false; `cost` is how far that is from what people would state."""

    atom: Atom
    holds: bool
    cost: int


class AtomReader(msgspec.Struct, frozen=True):
    """The action that needs an atom, as it has it in its conditions, `depth` actions before the goal."""

    depth: int
    action: Action
    atom: Atom

    @property
    def types(self) -> tuple[str | None, ...]:
        """The type of the parameter at each place of the atom; None if there is no parameter."""
        types = {each.name: each.type for each in self.action.parameters}
        return tuple(map(types.get, self.atom.terms))


class NearestChange(msgspec.Struct, frozen=True):
    """What is lacking combine_ways, each with what needs it."""

    lacking: tuple[tuple[Lack, AtomReader], ...]


Way: TypeAlias = frozenset[Lack]
"""What has to change together so that a formula can hold."""

Order: TypeAlias = tuple[str, tuple[str, ...], bool]
NOTHING: tuple[Way, ...] = (frozenset(),)


def combine_ways(options: Sequence[tuple[Way, ...]]) -> tuple[Way, ...]:
    """Return the ways that take one of each of the options."""
    ways: tuple[Way, ...] = NOTHING
    for each in options:
        ways = keep_cheapest(one | other for one, other in product(ways, each))
    return ways


def keep_cheapest(ways: Iterable[Way]) -> tuple[Way, ...]:
    """Return the ways of the least cost, each once, at most `MAX_WAYS`.

    Of each cost, those that lack the same in other individuals come after the first ones of the other kinds.
    """
    kinds: Counter[tuple[int, frozenset[tuple[str, bool]]]] = Counter()
    ranked: list[tuple[int, int, Way]] = []
    for way in sorted(dict.fromkeys(ways), key=_rank):
        kind = sum_costs(way), frozenset((each.atom.predicate, each.holds) for each in way)
        kinds[kind] += 1
        ranked.append((kind[0], kinds[kind], way))
    return tuple(way for _, _, way in sorted(ranked, key=lambda each: each[:2])[:MAX_WAYS])


def _rank(way: Way) -> tuple[int, list[Order]]:
    return sum_costs(way), sorted(map(to_order, way))


def sum_costs(way: Way) -> int:
    """Return what a way costs."""
    return sum(each.cost for each in way)


def to_order(lack: Lack) -> Order:
    """Return what lacks are sorted by."""
    return lack.atom.predicate, lack.atom.terms, lack.holds
