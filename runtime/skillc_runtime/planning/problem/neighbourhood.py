"""Selects the objects of a scene that a plan probably needs: those near the individuals of the goal.

These are the individuals that the goal refers to, all objects of types with few objects (robots, arms, grippers,
tools), those on shortest paths of facts between these (the places along the roads from a part to where it shall be),
step by step the objects that are related to them unless they have many partners in the relation (the location of an
object, the arm of a robot), and for each parameter of a skill some objects of its type, the nearest. A plan for the
selection is a plan for the scene, unless a `forall` ranges over an object that was left out; validation detects this.
It need not be the cheapest, and if there is none, the scene may still have one: see `abstraction.lower_bound`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from heapq import nsmallest

import msgspec
from msgspec.structs import replace

from skillc_model.pddl.domain import GuardMeaning, PlanningDomain, RelationMeaning
from skillc_runtime.planning.problem.shortest_paths import Links, ShortestPaths
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

MAX_RANKED = 500
"""How many objects of a type are ranked, the first by IRI."""


class AbstractionSize(msgspec.Struct, frozen=True):
    """How much of a scene is kept: all objects of types with up to `few`, and neighbours up to `objects` in total.

    For a scene of up to `whole` objects, and for any with `proves`, planning goes on to the whole scene until the plan
    is proven to be optimal.
    """

    objects: int
    few: int
    whole: int = 0
    proves: bool = False

    @property
    def most_kept(self) -> int:
        """The number of objects that may all be kept."""
        return max(self.objects, self.whole)

    def wider(self) -> AbstractionSize:
        """Return the size to try next."""
        return replace(self, objects=self.objects * 8, few=self.few * 8)


NARROW = AbstractionSize(40, 8, 100)

NARROWEST = AbstractionSize(20, 4)
"""For a first plan of one part of a goal."""

PROVING = replace(NARROW, proves=True)
"""For plans that are to be proven optimal, however large the scene is."""

AT_ONCE = AbstractionSize(100, 8)
"""For problems that are posed once and not for a larger part."""


def select_near(
    domain: PlanningDomain,
    state: WorldState,
    by_type: Mapping[str, Sequence[str]],
    named: Iterable[str],
    size: AbstractionSize,
) -> frozenset[str]:
    """Return the individuals to keep, among them all of `named`; `by_type` are the candidates."""
    return _NearbyObjects(domain, state, by_type, size).select(named)


class _NearbyObjects:
    def __init__(
        self, domain: PlanningDomain, state: WorldState, by_type: Mapping[str, Sequence[str]], size: AbstractionSize
    ) -> None:
        self._state, self._size = state, size
        relations = sorted(
            {each.meaning.relation for each in domain.predicates if isinstance(each.meaning, RelationMeaning)}
        )
        self._guards = [
            each.meaning
            for each in domain.predicates
            if isinstance(each.meaning, GuardMeaning) and len(each.meaning.variables) == 1
        ]
        wanted = sorted({each.type for action in domain.actions for each in action.parameters})
        self._members = [tuple(by_type[type_] for type_ in by_type if domain.is_a(type_, each)) for each in wanted]
        self._links = Links(state, relations, frozenset().union(*by_type.values()))

    def select(self, named: Iterable[str]) -> frozenset[str]:
        few = self._size.few
        start = set(named).union(*(each for types in self._members if sum(map(len, types)) <= few for each in types))
        paths = ShortestPaths(self._links, start)
        ways = paths.find_between()
        kept = self._grow(start | ways, self._size.objects + len(ways))
        spare: set[str] = set()
        for types in self._members:
            missing = few // 2 - sum(len(kept.intersection(each)) for each in types)
            if missing > 0:
                spare.update(self._find_nearest(types, kept, paths, missing))
        spare = spare.union(*map(paths.trace, spare)) - kept
        return frozenset(self._grow(kept | spare, self._size.objects + len(ways) + len(spare)))

    def _find_nearest(
        self, types: Sequence[Sequence[str]], kept: set[str], paths: ShortestPaths, count: int
    ) -> Iterable[str]:
        """Return the individuals of some types that are nearest to what is kept, or satisfy most; the first by IRI."""
        near = paths.find_nearest(frozenset().union(*types) - kept, count)
        if len(near) == count:
            return near
        missed = (iri for each in types for iri in each if iri not in kept and iri not in near)
        ranked = sorted(nsmallest(MAX_RANKED, missed), key=lambda iri: (-self._rank(iri), iri))
        return (*near, *ranked[: count - len(near)])

    def _grow(self, start: set[str], limit: int) -> set[str]:
        """Return the start and its nearest neighbours, up to `limit` individuals."""
        kept, ring = set(start), sorted(start)
        while ring and len(kept) < limit:
            new = {other for each in ring for other, far in self._links.of(each) if far <= 1.0} - kept
            ring = sorted(new)[: limit - len(kept)]
            kept.update(ring)
        return kept

    def _rank(self, individual: str) -> int:
        """Return how many relations and conditions of one variable the individual satisfies."""
        return self._links.count(individual) + sum(self._satisfies(guard, individual) for guard in self._guards)

    def _satisfies(self, guard: GuardMeaning, individual: str) -> bool:
        try:
            return evaluate(guard.condition, self._state, {guard.variables[0]: individual})
        except EvaluationError:
            return False
