"""The way of a mobile base to where it shall stand: straight, else around what stands in the scene.

A base turns on the spot and drives straight ahead. Where the straight way is not free, A* goes over a lattice of places
and of eight headings, and its corners are cut. Where that finds nothing, the cheapest way through things says what
blocks.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import count
from math import ceil, cos, hypot, inf, pi, remainder, sin
from typing import Final, TypeAlias

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose, rotation_from_angles
from skillc_runtime.world.space.floor_plan import FloorPlan, place_of
from skillc_runtime.world.state.world_state import WorldState

STEP_M: Final = 0.01
STEP_RAD: Final = 0.03
"""How far apart the poses are that are looked at on a way."""

SEARCHES_M: Final = ((0.2, 0.05), (0.1, 0.0))
"""The distances of places of the lattice and from things in m, in the order in which they are tried."""

HEADINGS: Final = 8
TURN_M: Final = 0.2
"""How many m of way a turn by 45 degrees counts."""

AROUND_M: Final = 2.0
"""How far around all things ways are looked for."""

MOST: Final = 5_000
"""How many nodes of the lattice are looked at."""

NEAR_M: Final = 1.0
"""From how near it is tried at each node to go straight to the goal; from farther away at each of EACH."""

EACH: Final = 40
THROUGH_M: Final = 20.0
"""How many m of way each step through a thing counts where what blocks is looked for."""

MOST_NAMED: Final = 3
"""How many things that block are named."""

Node: TypeAlias = tuple[int, int, int]
Place: TypeAlias = tuple[float, float, float]
"""Where a base is on the floor: x and y in m, and its heading in rad."""


@dataclass(frozen=True, slots=True, eq=False)
class BaseWay:
    """The poses to which a base drives in order, straight to each; `around` is what stands in the straight way."""

    poses: tuple[Pose, ...]
    around: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class BlockedWay:
    """No way was found: `by` are things that block all; `at_goal` if the base would touch them there."""

    by: tuple[str, ...]
    at_goal: bool = False


def find_base_way(plan: FloorPlan, start: Pose, goal: Pose) -> BaseWay | BlockedWay:
    """Return how a base drives on the floor without touching anything, or what blocks it.

    start, goal: poses of the base in the world.
    """
    straight = find_straight_way(plan, start, goal)
    if straight is not None:
        return straight
    here, there = place_of(start), place_of(goal)
    if touched := plan.find_touched(there[None]):
        return BlockedWay(touched, at_goal=True)
    around = plan.find_touched(_places_between(here, there))
    found = _find_corners(plan, tuple(here.tolist()), tuple(there.tolist()))
    if isinstance(found, BlockedWay):
        return BlockedWay(found.by or around)
    poses = [_pose_at(each, float(start.position[2])) for each in found[:-1]]
    return BaseWay((*poses, goal), around)


@lru_cache(maxsize=64)
def _find_corners(plan: FloorPlan, start: Place, goal: Place) -> tuple[Place, ...] | BlockedWay:
    """Return the places to which a base goes straight, one after another, the goal last, or what blocks all ways."""
    here, there = np.array(start), np.array(goal)
    for pitch_m, margin_m in SEARCHES_M:
        is_free = plan.keep_away(margin_m, there)
        found = _search_free(plan, here, there, pitch_m, is_free)
        if found is not None:
            return tuple((float(x), float(y), float(yaw)) for x, y, yaw in _cut_corners(is_free, here, found))
    pitch_m, _ = SEARCHES_M[0]
    through = _Lattice(plan, here, there, pitch_m, lambda each: THROUGH_M * len(plan.find_touched(each))).search()
    return BlockedWay(() if through is None else plan.find_touched(np.array(through)))


def describe_blocked(way: BlockedWay, state: WorldState, robot: str, to: str) -> str:
    """Return what blocks the way of a base to a place, as a sentence."""
    short = state.vocabulary.short
    named = " and ".join(short(each) for each in way.by[:MOST_NAMED])
    more = f" and {len(way.by) - MOST_NAMED} more" if way.by[MOST_NAMED:] else ""
    if way.at_goal:
        return f"{short(robot)} would touch {named}{more} where it shall stand at {short(to)}"
    return f"the way of {short(robot)} to {short(to)} is blocked by {named}{more}, and no way around was found"


def find_straight_way(plan: FloorPlan, start: Pose, goal: Pose) -> BaseWay | None:
    """Return the straight way of a base on the floor; None if something is in it.

    start, goal: poses of the base in the world.
    """
    places = _places_between(place_of(start), place_of(goal))
    return BaseWay((goal,)) if not len(places) or plan.is_free(places) else None


def _search_free(
    plan: FloorPlan, start: Array, goal: Array, pitch_m: float, is_free: Callable[[Array], bool]
) -> list[Array] | None:
    return _Lattice(plan, start, goal, pitch_m, lambda each: 0.0 if is_free(each) else inf).search()


class _Lattice:
    """A search over places at a distance from each other; `cost` of places is infinite if the base cannot be there."""

    def __init__(
        self, plan: FloorPlan, start: Array, goal: Array, pitch_m: float, cost: Callable[[Array], float]
    ) -> None:
        self._start, self._goal, self._pitch_m, self._cost = start, goal, pitch_m, cost
        ends = np.array([start[:2], goal[:2]])
        self._low = np.minimum(plan.low, ends.min(axis=0)) - AROUND_M
        self._high = np.maximum(plan.high, ends.max(axis=0)) + AROUND_M
        self._turns = dict[Node, float]()

    def search(self) -> list[Array] | None:
        """Return the places (3,) of a way after its start, the goal last; None if none was found."""
        before = dict[Node, Node | None]()
        order, queue = count(), list[tuple[float, int, float, Node, Node | None]]()

        def push(cost: float, node: Node, last: Node | None) -> None:
            if cost < inf:
                heapq.heappush(queue, (cost + self._left_m(node), next(order), cost, node, last))

        for heading in range(HEADINGS):
            node = (0, 0, heading)
            turn = _turned(self._start, self._place(node))
            push(TURN_M * HEADINGS * len(turn) * STEP_RAD / (2.0 * pi) + self._cost_of(turn), node, None)
        while queue and len(before) < MOST:
            _, _, cost, node, last = heapq.heappop(queue)
            if node in before:
                continue
            before[node] = last
            on = _places_between(self._place(node), self._goal) if self._may_end(node, len(before)) else None
            if on is not None and self._cost_of(on) < inf:
                return [*reversed([self._place(each) for each in _trace(before, node)]), self._goal]
            for after, step in self._steps(node):
                if after not in before:
                    push(cost + step, after, node)
        return None

    def _steps(self, node: Node) -> Iterator[tuple[Node, float]]:
        x, y, heading = node
        for turned, gap in (((heading + 1) % HEADINGS, heading), ((heading - 1) % HEADINGS, (heading - 1) % HEADINGS)):
            there, way = (x, y, turned), (x, y, gap)
            if way not in self._turns:
                self._turns[way] = self._cost_of(_turned(self._place(node), self._place(there)))
            yield there, TURN_M + self._turns[way]
        angle = 2.0 * pi * heading / HEADINGS
        ahead = (x + round(cos(angle)), y + round(sin(angle)), heading)
        there_at = self._place(ahead)
        if (there_at[:2] >= self._low).all() and (there_at[:2] <= self._high).all():
            away_m = self._pitch_m * hypot(ahead[0] - x, ahead[1] - y)
            yield ahead, away_m + self._cost_of(_moved(self._place(node), there_at))

    def _cost_of(self, places: Array) -> float:
        return self._cost(places) if len(places) else 0.0

    def _may_end(self, node: Node, looked_at: int) -> bool:
        return self._left_m(node) < NEAR_M or looked_at % EACH == 0

    def _left_m(self, node: Node) -> float:
        x, y, _ = self._place(node)
        return hypot(self._goal[0] - x, self._goal[1] - y)

    def _place(self, node: Node) -> Array:
        x, y, heading = node
        return np.array(
            [self._start[0] + self._pitch_m * x, self._start[1] + self._pitch_m * y, 2.0 * pi * heading / HEADINGS]
        )


def _cut_corners(is_free: Callable[[Array], bool], start: Array, places: Sequence[Array]) -> list[Array]:
    """Return fewer places on a way: each is the farthest to which the base can go straight from the one before."""
    found, at, left = list[Array](), start, list(places)
    while left:
        number = next((each for each in reversed(range(len(left))) if _goes_straight(is_free, at, left, each)), 0)
        last = number == len(left) - 1
        there = left[number] if last else _arriving(at, left[number])
        if last or _apart_m(at, there) > 1e-6:
            found.append(there)
        at, left = there, left[number + 1 :]
    return found


def _goes_straight(is_free: Callable[[Array], bool], at: Array, left: Sequence[Array], number: int) -> bool:
    """Whether the base can go straight to one of the places that are left, and on from there."""
    last = number == len(left) - 1
    there = left[number] if last else _arriving(at, left[number])
    on = _places_between(there, there if last else _arriving(there, left[number + 1]))
    ways = np.concatenate([_places_between(at, there), on])
    return not len(ways) or is_free(ways)


def _arriving(at: Array, there: Array) -> Array:
    """Return a place (3,) as the base comes there from another one: heading along its way."""
    heading = at[2] if _apart_m(at, there) < 1e-6 else np.arctan2(there[1] - at[1], there[0] - at[0])
    return np.array([there[0], there[1], heading])


def _places_between(start: Array, goal: Array) -> Array:
    """Return places (n, 3) on a drive, without its start: a turn on the spot, a straight way, another turn."""
    ahead = _arriving(start, goal)
    first = np.array([start[0], start[1], ahead[2]])
    return np.concatenate([_turned(start, first), _moved(first, ahead), _turned(ahead, goal)])


def _turned(start: Array, goal: Array) -> Array:
    turn = remainder(goal[2] - start[2], 2.0 * pi)
    steps = ceil(abs(turn) / STEP_RAD)
    places: Array = start + np.linspace(0.0, 1.0, steps + 1)[1:, None] * np.array([0.0, 0.0, turn])
    return places


def _moved(start: Array, goal: Array) -> Array:
    steps = ceil(_apart_m(start, goal) / STEP_M)
    way = np.array([goal[0] - start[0], goal[1] - start[1], 0.0])
    places: Array = start + np.linspace(0.0, 1.0, steps + 1)[1:, None] * way
    return places


def _apart_m(one: Array, other: Array) -> float:
    return hypot(other[0] - one[0], other[1] - one[1])


def _pose_at(place: Place, z_m: float) -> Pose:
    x_m, y_m, heading = place
    return Pose(np.array([x_m, y_m, z_m]), rotation_from_angles(0.0, 0.0, heading))


def _trace(before: dict[Node, Node | None], node: Node) -> Iterator[Node]:
    at: Node | None = node
    while at is not None:
        yield at
        at = before[at]
