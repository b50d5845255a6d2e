"""Lanes over surfaces with holes, and over several patches: pieces between which the tool is lifted.

Lanes are cut where the tool would touch a hole. Beside each hole run two lanes more, along which the tool just passes
it, as far as other lanes are cut by that hole. Whatever the tool can be over without touching a hole is passed then:
moved across towards the nearest lane, it either gets there or is stopped by a hole, beside which it is on such a lane.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from skillc_runtime.motion.lanes import OVERHANG_M, Direction, plan_lanes
from skillc_runtime.motion.layout import Hole, Layout
from skillc_runtime.motion.pose import Array, Pose

Stroke = list[Pose]
"""Poses that the tool goes through without leaving the surface."""

LIFT_M = 1.0
"""Lifting the tool and putting it down again takes as long as so much way on the surface."""

SAME_M = 1e-6
"""Nearer than this, two lanes are one."""


def plan_strokes(
    surface: Array, tool: Array, overlap: float, holes: Sequence[Hole] = (), direction: Direction = "longer"
) -> list[Stroke]:
    """Return lanes, as `lanes` has them, that touch no hole nor the half of its margin; in the surface frame.

    surface (2,), tool (2,): sizes in m. One stroke goes on from lane to lane as long as the way there touches no hole,
    each time to the nearest that is left. ValueError as for `lanes`.
    """
    ends = plan_lanes(surface, tool, overlap, OVERHANG_M, direction)
    kept = [hole.grow(hole.margin / 2) for hole in holes]
    if not kept:
        return [ends]
    whole = list(zip(ends[::2], ends[1::2], strict=True))
    pieces = [piece for lane in whole for piece in _pieces(*lane, tool, kept)]
    beside = [piece for hole in kept for lane in _beside(whole, tool, hole) for piece in _pieces(*lane, tool, kept)]
    return _joined(pieces + beside, tool, kept) if pieces or beside else []


def plan_layout_strokes(
    layout: Layout, tool: Array, overlap: float, start: Pose, direction: Direction = "longer"
) -> list[Stroke]:
    """Return the strokes over all parts of a surface, in its frame, each time those of the part that begins nearest.

    tool (2,): size in m; overlap: share of its width; start: in the surface frame.
    """
    left = [
        [
            [part.pose @ pose for pose in stroke]
            for stroke in plan_strokes(
                part.size, tool, overlap, [h.in_frame(part.pose) for h in layout.holes], direction
            )
        ]
        for part in layout.parts
    ]
    left = [found for found in left if found]
    ordered: list[Stroke] = []
    place = start.position
    while left:
        nearest = int(np.argmin([np.linalg.norm(found[0][0].position - place) for found in left]))
        ordered += left.pop(nearest)
        place = ordered[-1][-1].position
    return ordered


def _pieces(start: Pose, end: Pose, tool: Array, holes: Sequence[Hole]) -> Iterator[Stroke]:
    """Yield what is left of a lane without the ways on which the tool would touch a hole, in the lane's direction."""
    way = end.position - start.position
    ahead = start.rotation[:, 0] * (1.0 if way @ start.rotation[:, 0] >= 0 else -1.0)
    length = float(np.linalg.norm(way))
    blocked = sorted(_blocked(start, ahead, tool, hole) for hole in holes if _meets(start, tool, hole))
    free_from = 0.0
    for first, last in [*blocked, (np.inf, np.inf)]:
        if min(first, length) >= free_from:
            yield [Pose(start.position + at * ahead, start.rotation) for at in (free_from, min(first, length))]
        free_from = max(free_from, last)


def _reach(start: Pose, tool: Array, hole: Hole) -> Array:
    """Return how near (2,), along the surface's axes, the tool's middle may come to the hole's without touching it."""
    return np.asarray((np.abs(start.rotation[:2, :2]) @ tool[:2] + hole.size) / 2)


def _meets(start: Pose, tool: Array, hole: Hole) -> bool:
    """Tell whether the lane is so near to the hole that the tool touches it."""
    across = np.abs(start.rotation[:2, 1])
    away = np.abs(hole.middle - start.position[:2])
    return float(across @ away) < float(across @ _reach(start, tool, hole)) - SAME_M


def _blocked(start: Pose, ahead: Array, tool: Array, hole: Hole) -> tuple[float, float]:
    """Return between which places on the lane, in m from its start, the tool touches the hole."""
    middle = float(ahead[:2] @ (hole.middle - start.position[:2]))
    reach = float(np.abs(ahead[:2]) @ _reach(start, tool, hole))
    return middle - reach, middle + reach


def _beside(whole: Sequence[tuple[Pose, Pose]], tool: Array, hole: Hole) -> Iterator[tuple[Pose, Pose]]:
    """Yield the lanes, not among `whole`, on which the tool passes right beside a hole, for as long as it does."""
    rotation, places = whole[0][0].rotation, np.array([end.position[:2] for lane in whole for end in lane])
    along, across = np.abs(rotation[:2, 0]), np.abs(rotation[:2, 1])
    reach, nearest, farthest = _reach(whole[0][0], tool, hole), places.min(axis=0), places.max(axis=0)
    first = max(float(along @ (hole.middle - reach)), float(along @ nearest))
    last = min(float(along @ (hole.middle + reach)), float(along @ farthest))
    for side in (across @ (hole.middle - reach), across @ (hole.middle + reach)):
        taken = bool((np.abs(places @ across - side) < SAME_M).any())
        if first <= last and across @ nearest < side < across @ farthest and not taken:
            start, end = (Pose(np.append(at * along + side * across, 0.0), rotation) for at in (first, last))
            yield start, end


def _joined(pieces: Sequence[Stroke], tool: Array, holes: Sequence[Hole]) -> list[Stroke]:
    """Return the pieces in an order, and each in a direction, that leave the surface seldom and make short ways."""
    turned = [way for piece in pieces for way in (piece, piece[::-1])]
    lifts = np.array([[not _clear(one[-1], other[0], tool, holes) for other in turned] for one in turned], dtype=float)
    ends = np.array([[way[0].position, way[-1].position] for way in turned])
    costs = LIFT_M * lifts + np.linalg.norm(ends[:, None, 1] - ends[None, :, 0], axis=-1)
    orders = [_order(costs, first) for first in range(len(turned))]
    found: list[Stroke] = []
    for before, now in pairwise([-1, *min(orders, key=lambda order: _length(costs, order))]):
        if before >= 0 and not lifts[before, now]:
            found[-1] += turned[now]
        else:
            found.append(list(turned[now]))
    return found


def _order(costs: Array, first: int) -> list[int]:
    """Return all pieces from a first one on, each time the cheapest; 2 i and 2 i + 1 are one, run to and fro."""
    order, left = [first], np.ones(len(costs), dtype=bool)
    while True:
        left[[order[-1], order[-1] ^ 1]] = False
        if not left.any():
            return order
        order.append(int(np.where(left, np.round(costs[order[-1]], 6), np.inf).argmin()))


def _length(costs: Array, order: list[int]) -> float:
    return round(float(sum(costs[before, now] for before, now in pairwise(order))), 6)


def _clear(start: Pose, end: Pose, tool: Array, holes: Sequence[Hole]) -> bool:
    """Tell whether the rectangle around the tool at both ends of a way touches no hole."""
    half = np.abs(start.rotation[:2, :2]) @ tool[:2] / 2
    places = np.array([start.position[:2], end.position[:2]])
    low, high = places.min(axis=0) - half + SAME_M, places.max(axis=0) + half - SAME_M
    return all(
        bool((hole.middle + hole.size / 2 <= low).any() or (hole.middle - hole.size / 2 >= high).any())
        for hole in holes
    )
