"""What a planning problem lacks so that a formula can hold, the ways to make it hold, and what to state for that."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from itertools import product
from typing import TypeAlias

import msgspec

from skillc_model.pddl.domain import Action
from skillc_model.pddl.formulas import Atom
from skillc_runtime.world.state.world_state import WorldState

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


def is_expected(state: WorldState, relation: str, subject: str, object_: str) -> bool:
    """Whether one of two individuals has no such relation, and at least half of the others of its classes have one."""

    def lacks(individual: str, having: Callable[[str], frozenset[str]]) -> bool:
        peers = {each for cls in state.types(individual) for each in state.instances(cls)} - {individual}
        return not having(individual) and 2 * sum(bool(having(each)) for each in peers) >= len(peers)

    return lacks(subject, lambda each: frozenset(state.objects(each, relation))) or lacks(
        object_, lambda each: frozenset(state.subjects(relation, each))
    )


def find_stated(state: WorldState, relation: str, subject: str, object_: str) -> str | None:
    """Return the relation to state so that this one holds: the narrowest that takes both; None unless there is one.

    Of relations of which none is below another, that is the one whose classes are below those of the others.
    """
    known, above, is_a = state.vocabulary.relations, state.vocabulary.super_relations, state.vocabulary.is_a
    sides = {
        iri: [each for each in term.signatures if state.is_a(subject, each.domain) and state.is_a(object_, each.range)]
        for iri, term in known.items()
        if relation in above[iri] and not state.vocabulary.is_computed(iri)
    }
    fitting = [each for each in sides if sides[each]]
    lowest = [each for each in fitting if not any(each in above[other] for other in fitting if other != each)]

    def is_within(one: str, other: str) -> bool:
        pairs = product(sides[one], sides[other])
        return any(is_a(each.domain, wide.domain) and is_a(each.range, wide.range) for each, wide in pairs)

    narrowest = [each for each in lowest if all(is_within(each, other) for other in lowest)]
    return narrowest[0] if len(narrowest) == 1 else None
