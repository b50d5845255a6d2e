"""Finds shortest paths of facts between individuals: `a R b` leads from a to b and back.

A fact of an individual with many partners in its relation is a longer step, since it says less: that a hall contains
each of a hundred places brings none of them near another one.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from functools import cache
from heapq import heappop, heappush

from skillc_runtime.world.state.world_state import WorldState

NEAR_PARTNERS = 4
"""The partners of an individual in a relation are one step from it if it has at most this many; else that multiple."""

MOST_PARTNERS = 64
"""The partners of an individual with more of them in a relation are not visited from it."""

MOST_VISITED = 5_000
"""How many individuals are visited."""


class Links:
    """The steps between `known` individuals by facts of some relations (IRIs)."""

    def __init__(self, state: WorldState, relations: Sequence[str], known: Set[str]) -> None:
        self._state, self._relations, self._known = state, relations, known
        self.of = cache(lambda individual: tuple(self._list(individual)))
        """Returns the partners of an individual, each with its distance, 1 for a near one."""

    def count(self, individual: str) -> int:
        """Return in how many roles of relations an individual is."""
        return sum(bool(partners) for partners in self._partners(individual))

    def _list(self, individual: str) -> Iterator[tuple[str, float]]:
        for partners in self._partners(individual):
            if len(partners) <= MOST_PARTNERS:
                far = max(1.0, len(partners) / NEAR_PARTNERS)
                yield from ((each, far) for each in sorted(partners) if each in self._known)

    def _partners(self, individual: str) -> Iterator[Set[str]]:
        for relation in self._relations:
            yield self._state.objects(individual, relation)
            yield self._state.subjects(relation, individual)


class ShortestPaths:
    """The shortest paths from any of the `sources` to what lies around them (Dijkstra), visited on demand."""

    def __init__(self, links: Links, sources: Set[str]) -> None:
        self._links, self._sources = links, sources
        self._parents: dict[str, str] = {}
        self._distances = dict.fromkeys(sources, 0.0)
        self._queue = [(0.0, each) for each in sorted(sources)]
        self._visited: dict[str, float] = {}

    def trace(self, individual: str) -> Iterator[str]:
        """Yield an individual and those between it and the nearest source, as far as it was visited."""
        while individual not in self._sources:
            yield individual
            if individual not in self._parents:
                return
            individual = self._parents[individual]

    def find_nearest(self, wanted: Set[str], count: int) -> tuple[str, ...]:
        """Return the nearest of the wanted individuals, at most `count` of those that are visited."""
        found = [each for each in self._visited if each in wanted]
        while len(found) < count and (individual := self._visit()) is not None:
            if individual in wanted:
                found.append(individual)
        return tuple(found[:count])

    def find_between(self) -> set[str]:
        """Return what lies on paths that join the sources, as far as they are joined by what is visited.

        Of the paths between sources that meet, those of a minimum spanning tree are taken: Mehlhorn, "A faster
        approximation algorithm for the Steiner problem in graphs", 1988; but only of what is visited until all meet.
        """
        groups = {each: each for each in self._sources}
        origins: dict[str, str] = {}
        meetings: list[tuple[float, str, str]] = []
        parts = len(groups)
        while parts > 1 and (individual := self._visit()) is not None:
            origins[individual] = _origin(individual, self._parents)
            for other, step in self._links.of(individual):
                if other in origins and origins[other] != origins[individual]:
                    meetings.append((self._visited[individual] + step + self._visited[other], individual, other))
                    parts -= _unite(origins[individual], origins[other], groups)
        groups = {each: each for each in self._sources}
        between: set[str] = set()
        for _, one, other in sorted(meetings):
            if _unite(origins[one], origins[other], groups):
                between.update(self.trace(one), self.trace(other))
        return between

    def _visit(self) -> str | None:
        """Visit the next nearest individual; None if there is none, or enough were visited."""
        while self._queue and len(self._visited) < MOST_VISITED:
            far, individual = heappop(self._queue)
            if individual in self._visited:
                continue
            self._visited[individual] = far
            for other, step in self._links.of(individual):
                if far + step < self._distances.get(other, float("inf")):
                    self._distances[other], self._parents[other] = far + step, individual
                    heappush(self._queue, (far + step, other))
            return individual
        return None


def _origin(individual: str, parents: Mapping[str, str]) -> str:
    while individual in parents:
        individual = parents[individual]
    return individual


def _unite(one: str, other: str, groups: dict[str, str]) -> bool:
    """Make one group of those of two individuals, each named by one of its members; return whether there were two."""
    one, other = _root(one, groups), _root(other, groups)
    groups[one] = other
    return one != other


def _root(individual: str, groups: Mapping[str, str]) -> str:
    while groups[individual] != individual:
        individual = groups[individual]
    return individual
