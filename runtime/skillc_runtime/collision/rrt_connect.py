"""A path around obstacles by two trees that grow towards each other; its corners are cut off then, where there is room.

J. J. Kuffner, S. M. LaValle, RRT-Connect: an efficient approach to single-query path planning, ICRA 2000. It ends after
a number of random points, not after a time, so the same seed gives the same path on every machine.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from skillc_runtime.motion.pose import Array

Reach: TypeAlias = Callable[[Array, Array], float]
"""How far the straight way from one point (n,) to another is free, as a share: 1 for all, 0 for less than half."""

LONGEST = 0.35
"""How long one piece of a tree is at most, as a share of the diagonal of the bounds."""

CUTS = (0.75, 0.5, 0.25)
"""Shares of the two pieces at a corner that are cut off with it if possible, each at all corners in turn."""


def sample_path(reach: Reach, start: Array, goal: Array, bounds: Array, rounds: int, seed: int) -> list[Array] | None:
    """Return the points (n,) of a path from start to goal whose straight pieces are free; None if none was found.

    At most `rounds` random points are drawn.
    start: (n,) in any unit, such as joints in rad.
    goal: (n,) in any unit, that of the start.
    bounds: (n, 2) in any unit, that of the start; they contain start and goal.
    """
    draw, low, span = np.random.default_rng(seed), bounds[:, 0], bounds[:, 1] - bounds[:, 0]
    longest = LONGEST * float(np.linalg.norm(span))
    one, other = _Tree(start, longest), _Tree(goal, longest)
    for _ in range(rounds):
        new = one.grow(reach, low + span * draw.random(len(start)))
        met = None if new is None else other.connect(reach, one.points[new])
        if new is not None and met is not None:
            ways = one.way_to(new), other.way_to(met)
            there, back = ways if one.points[0] is start else ways[::-1]
            return shorten([*there, *back[-2::-1]], reach)
        one, other = other, one
    return None


def shorten(points: list[Array], reach: Reach) -> list[Array]:
    """Return a path from the first to the last of the points of one, shorter where the way is free.

    points: each (n,) in any unit.
    """
    points = _skip(points, reach)
    for share in CUTS:
        kept = points[:1]
        for corner, after in pairwise(points[1:]):
            ends = [corner + share * (end - corner) for end in (kept[-1], after)]
            kept += ends if reach(*ends) == 1.0 else [corner]
        points = [*kept, points[-1]]
    return _skip(points, reach)


def _skip(points: list[Array], reach: Reach) -> list[Array]:
    """Return the path without the points that can be left out, first as many as possible at once."""
    kept, here, last = points[:1], 0, len(points) - 1
    while here < last:
        ahead = range(last, here + 1, -1)
        here = next((each for each in ahead if reach(points[here], points[each]) == 1.0), here + 1)
        kept.append(points[here])
    return kept


class _Tree:
    """Points that are joined by free pieces, each with the one before it."""

    def __init__(self, root: Array, longest: float) -> None:
        self.points, self._before, self._longest = [root], [-1], longest
        self._all = np.tile(root, (64, 1))

    def grow(self, reach: Reach, towards: Array) -> int | None:
        """Add a point in the direction of another, as far as the way is free; return its number, None without one."""
        away = self._all[: len(self.points)] - towards
        squares = np.einsum("ij,ij->i", away, away)
        near = int(squares.argmin())
        here, far = self.points[near], float(np.sqrt(squares[near]))
        there = towards if far <= self._longest else here + self._longest / far * (towards - here)
        free = reach(here, there) if far > 0.0 else 0.0
        if free == 0.0:
            return None
        return self._add(there if free == 1.0 else here + free * (there - here), near)

    def connect(self, reach: Reach, point: Array) -> int | None:
        """Grow to a point as long as the way is free; return the number of that point, None if it is not reached."""
        while (new := self.grow(reach, point)) is not None:
            if self.points[new] is point:
                return new
        return None

    def way_to(self, number: int) -> list[Array]:
        """Return the points from the root to the one with a number."""
        way: list[Array] = []
        while number >= 0:
            way.append(self.points[number])
            number = self._before[number]
        return way[::-1]

    def _add(self, point: Array, before: int) -> int:
        number = len(self.points)
        if number == len(self._all):
            self._all = np.concatenate([self._all, self._all])
        self._all[number] = point
        self.points.append(point)
        self._before.append(before)
        return number
