"""A path around obstacles by two trees that grow towards each other, and then as short as it gets in a few attempts.

J. J. Kuffner, S. M. LaValle, RRT-Connect: an efficient approach to single-query path planning, ICRA 2000. It ends after
a number of looks, not after a time, so the same seed gives the same path on every machine.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from skillc_runtime.motion.pose import Array

Reach: TypeAlias = Callable[[Array, Array], float]
"""How far the straight way from one point (n,) to another is free, as a share of it: 1 for all of it."""

LONGEST = 0.35
"""How long one piece of a tree is at most, as a share of the diagonal of the bounds."""

LEAST = 0.05
"""A piece of which less than this share is free is not kept."""

SHORTCUTS = 12
"""How often a random shortcut is tried."""


def sample_path(reach: Reach, start: Array, goal: Array, bounds: Array, rounds: int, seed: int) -> list[Array] | None:
    """Return the points (n,) of a path from start to goal whose straight pieces are free; None if none was found.

    bounds (n, 2) contain start and goal. At most `rounds` random points are drawn.
    """
    draw = np.random.default_rng(seed)
    low, span = bounds[:, 0], bounds[:, 1] - bounds[:, 0]
    longest = LONGEST * float(np.linalg.norm(span))
    one, other = _Tree(start, longest), _Tree(goal, longest)
    for _ in range(rounds):
        new = one.grow(reach, low + span * draw.random(len(start)))
        if new is not None:
            met = other.connect(reach, one.points[new])
            if met is not None:
                ways = one.way_to(new), other.way_to(met)
                there, back = ways if one.points[0] is start else ways[::-1]
                return shorten([*there, *back[-2::-1]], reach, draw)
        one, other = other, one
    return None


def shorten(points: list[Array], reach: Reach, draw: np.random.Generator) -> list[Array]:
    """Return a path from the first to the last of the points (n,) of one, with shortcuts where the way is free."""
    points = _skip(points, reach)
    for _ in range(SHORTCUTS):
        if len(points) < 3:
            break
        lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
        ends = np.concatenate([[0.0], np.cumsum(lengths)])
        first, last = np.sort(draw.random(2)) * ends[-1]
        i, j = (int(np.searchsorted(ends, each, side="right")) - 1 for each in (first, last))
        if i == j:
            continue
        a, b = (
            points[k] + (points[k + 1] - points[k]) * ((each - ends[k]) / lengths[k])
            for k, each in ((i, first), (j, last))
        )
        if reach(a, b) == 1.0:
            points = _skip([*points[: i + 1], a, b, *points[j + 1 :]], reach)
    return points


def _skip(points: list[Array], reach: Reach) -> list[Array]:
    """Return the path without the points that can be left out, first as many as possible at once."""
    kept, here = [points[0]], 0
    while here < len(points) - 1:
        there = next(
            (k for k in range(len(points) - 1, here + 1, -1) if reach(points[here], points[k]) == 1.0), here + 1
        )
        kept.append(points[there])
        here = there
    return kept


class _Tree:
    """Points that are joined by free pieces, each with the one before it."""

    def __init__(self, root: Array, longest: float) -> None:
        self.points, self._before, self._longest = [root], [-1], longest
        self._all = np.empty((64, len(root)))
        self._all[0] = root

    def grow(self, reach: Reach, towards: Array) -> int | None:
        """Add a point in the direction of another, as far as the way is free; return its number, None without one."""
        near = self._nearest(towards)
        here, way = self.points[near], towards - self.points[near]
        far = float(np.linalg.norm(way))
        if far < 1e-9:
            return near
        share = min(1.0, self._longest / far)
        there = towards if share == 1.0 else here + share * way
        free = reach(here, there)
        if free < LEAST:
            return None
        return self._add(there if free == 1.0 else here + free * (there - here), near)

    def connect(self, reach: Reach, point: Array) -> int | None:
        """Grow to a point as long as the way is free; return the number of that point, None if it is not reached."""
        while (new := self.grow(reach, point)) is not None:
            if self.points[new] is point:
                return new
            if float(np.linalg.norm(self.points[new] - self.points[self._before[new]])) < 0.99 * self._longest:
                return None
        return None

    def way_to(self, number: int) -> list[Array]:
        """Return the points from the root to the one with a number."""
        way: list[Array] = []
        while number >= 0:
            way.append(self.points[number])
            number = self._before[number]
        return way[::-1]

    def _nearest(self, point: Array) -> int:
        away = self._all[: len(self.points)] - point
        return int(np.einsum("ij,ij->i", away, away).argmin())

    def _add(self, point: Array, before: int) -> int:
        number = len(self.points)
        if number == len(self._all):
            self._all = np.concatenate([self._all, np.empty_like(self._all)])
        self._all[number] = point
        self.points.append(point)
        self._before.append(before)
        return number
