"""Strokes over surfaces with holes and over several patches; the tool is lifted between strokes.

Lanes are cut where the tool would touch a hole. On both sides of each hole a lane is added along which the tool just
passes it, as far as other lanes are cut by that hole. This covers every point that the tool can reach without touching
a hole: moved across towards the nearest lane, it either arrives there or is stopped by a hole, on its added lane.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.lanes import OVERHANG_M, Direction, plan_lanes
from skillc_runtime.motion.layout import Hole, Layout
from skillc_runtime.motion.pose import Array, Pose

Stroke = list[Pose]
"""Poses in the surface frame that the tool passes without leaving the surface."""

LIFT_M = 1.0
"""Lifting the tool and lowering it again costs as much as this distance on the surface."""

SAME_M = 1e-6
"""Lanes at a smaller distance are the same."""


def plan_strokes(
    surface: Array, tool: Array, overlap: float, holes: Sequence[Hole] = (), direction: Direction = "longer"
) -> list[Stroke]:
    """Return lanes as of `plan_lanes` that stay clear of holes and half their margins, in the surface frame.

    A stroke continues from lane to lane, each time to the nearest one left, while the tool touches no hole on the way.
    ValueError as for `plan_lanes`.
    surface: (2,) in m, its size.
    tool: (2,) in m, its size.
    overlap: share of the tool's width.
    """
    ends = plan_lanes(surface, tool, overlap, OVERHANG_M, direction)
    kept = [hole.grow(hole.margin / 2) for hole in holes]
    if not kept:
        return [ends]
    whole = list(zip(ends[::2], ends[1::2], strict=True))
    pieces = [piece for lane in whole for piece in _pieces(*lane, tool, kept)]
    beside = [piece for hole in kept for lane in _beside(whole, tool, hole) for piece in _pieces(*lane, tool, kept)]
    return _connect(pieces + beside, tool, kept) if pieces or beside else []


def plan_layout_strokes(
    layout: Layout, tool: Array, overlap: float, start: Pose, direction: Direction = "longer"
) -> list[Stroke]:
    """Return the strokes over all parts of a surface, in its frame, the nearest part first.

    tool: (2,) in m, its size.
    overlap: share of the tool's width.
    start: pose in the surface frame.
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
    """Yield the parts of a lane on which the tool touches no hole, in the direction of the lane."""
    way = end.position - start.position
    ahead = start.rotation[:, 0] * (1.0 if way @ start.rotation[:, 0] >= 0 else -1.0)
    length = float(np.linalg.norm(way))
    blocked = sorted(_blocked_interval(start, ahead, tool, hole) for hole in holes if _touches(start, tool, hole))
    free_from = 0.0
    for first, last in [*blocked, (np.inf, np.inf)]:
        if min(first, length) >= free_from:
            yield [Pose(start.position + at * ahead, start.rotation) for at in (free_from, min(first, length))]
        free_from = max(free_from, last)


def _reach(start: Pose, tool: Array, hole: Hole) -> Array:
    """Return the distance (2,) in m, along the surface's axes, between the centres of tool and hole at contact."""
    return np.asarray((np.abs(start.rotation[:2, :2]) @ tool[:2] + hole.size) / 2)


def _touches(start: Pose, tool: Array, hole: Hole) -> bool:
    """Tell whether the tool touches the hole somewhere on the line of the lane."""
    across = np.abs(start.rotation[:2, 1])
    away = np.abs(hole.centre - start.position[:2])
    return float(across @ away) < float(across @ _reach(start, tool, hole)) - SAME_M


def _blocked_interval(start: Pose, ahead: Array, tool: Array, hole: Hole) -> tuple[float, float]:
    """Return the interval on the lane, in m from its start, on which the tool touches the hole."""
    middle = float(ahead[:2] @ (hole.centre - start.position[:2]))
    reach = float(np.abs(ahead[:2]) @ _reach(start, tool, hole))
    return middle - reach, middle + reach


def _beside(whole: Sequence[tuple[Pose, Pose]], tool: Array, hole: Hole) -> Iterator[tuple[Pose, Pose]]:
    """Yield the lanes, unless they are among `whole`, on which the tool just passes a hole, as long as the hole is."""
    rotation, places = whole[0][0].rotation, np.array([end.position[:2] for lane in whole for end in lane])
    along, across = np.abs(rotation[:2, 0]), np.abs(rotation[:2, 1])
    reach, nearest, farthest = _reach(whole[0][0], tool, hole), places.min(axis=0), places.max(axis=0)
    first = max(float(along @ (hole.centre - reach)), float(along @ nearest))
    last = min(float(along @ (hole.centre + reach)), float(along @ farthest))
    for side in (across @ (hole.centre - reach), across @ (hole.centre + reach)):
        taken = bool((np.abs(places @ across - side) < SAME_M).any())
        if first <= last and across @ nearest < side < across @ farthest and not taken:
            start, end = (Pose(np.append(at * along + side * across, 0.0), rotation) for at in (first, last))
            yield start, end


def _connect(pieces: Sequence[Stroke], tool: Array, holes: Sequence[Hole]) -> list[Stroke]:
    """Return the pieces in an order and in directions with few lifts and short connections."""
    turned = [way for piece in pieces for way in (piece, piece[::-1])]
    lifts = np.array(
        [[not _is_clear(one[-1], other[0], tool, holes) for other in turned] for one in turned], dtype=float
    )
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
    """Return the order of all pieces from a first one on, each time the cheapest.

    2 i and 2 i + 1 are the two directions.
    """
    order, left = [first], np.ones(len(costs), dtype=bool)
    while True:
        left[[order[-1], order[-1] ^ 1]] = False
        if not left.any():
            return order
        order.append(int(np.where(left, np.round(costs[order[-1]], 6), np.inf).argmin()))


def _length(costs: Array, order: list[int]) -> float:
    return round(float(sum(costs[before, now] for before, now in pairwise(order))), 6)


def _is_clear(start: Pose, end: Pose, tool: Array, holes: Sequence[Hole]) -> bool:
    """Tell whether the rectangle around the tool at both ends of a connection touches no hole."""
    half = np.abs(start.rotation[:2, :2]) @ tool[:2] / 2
    places = np.array([start.position[:2], end.position[:2]])
    low, high = places.min(axis=0) - half + SAME_M, places.max(axis=0) + half - SAME_M
    return all(
        bool((hole.centre + hole.size / 2 <= low).any() or (hole.centre - hole.size / 2 >= high).any())
        for hole in holes
    )
