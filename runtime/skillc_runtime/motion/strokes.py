"""Lanes over surfaces with holes, and over several patches: pieces between which the tool is lifted.

Lanes are cut where the tool would touch a hole. Beside each hole run two lanes more, along which the tool just passes
it, as far as other lanes are cut by that hole. Whatever the tool can be over without touching a hole is passed then:
moved across towards the nearest lane, it either gets there or is stopped by a hole, beside which it is on such a lane.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from skillc_runtime.motion.lanes import OVERHANG_M, Direction, lanes
from skillc_runtime.motion.layout import Hole, Layout
from skillc_runtime.motion.pose import Array, Pose

Stroke = list[Pose]
"""Poses that the tool goes through without leaving the surface."""

SAME_M = 1e-6
"""Nearer than this, two lanes are one."""


def strokes(
    surface: Array, tool: Array, overlap: float, holes: Sequence[Hole] = (), direction: Direction = "longer"
) -> list[Stroke]:
    """Return lanes, as `lanes` has them, that touch no hole nor the half of its margin; in the surface frame.

    One stroke goes on from lane to lane as long as the way there touches no hole, each time to the nearest that is
    left. ValueError as for `lanes`.
    """
    ends = lanes(surface, tool, overlap, OVERHANG_M, direction)
    kept = [hole.grown(hole.margin / 2) for hole in holes]
    if not kept:
        return [ends]
    whole = list(zip(ends[::2], ends[1::2], strict=True))
    pieces = [piece for lane in whole for piece in _pieces(*lane, tool, kept)]
    beside = [piece for hole in kept for lane in _beside(whole, tool, hole) for piece in _pieces(*lane, tool, kept)]
    return _joined(pieces + beside, tool, kept)


def over(layout: Layout, tool: Array, overlap: float, start: Pose, direction: Direction = "longer") -> list[Stroke]:
    """Return the strokes over all parts of a surface, in its frame, each time those of the part that begins nearest."""
    left = [
        [
            [part.pose @ pose for pose in stroke]
            for stroke in strokes(part.size, tool, overlap, [h.seen_from(part.pose) for h in layout.holes], direction)
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
    found, left = [list(pieces[0])] if pieces else [], list(pieces[1:])
    while left:
        here = found[-1][-1]
        ways = [(turned, i) for i in range(len(left)) for turned in (left[i], left[i][::-1])]
        stroke, index = min(
            ways,
            key=lambda way: (
                not _clear(here, way[0][0], tool, holes),
                round(float(np.linalg.norm(way[0][0].position - here.position)), 6),
            ),
        )
        left.pop(index)
        if _clear(here, stroke[0], tool, holes):
            found[-1] += stroke
        else:
            found.append(list(stroke))
    return found


def _clear(start: Pose, end: Pose, tool: Array, holes: Sequence[Hole]) -> bool:
    """Tell whether the rectangle around the tool at both ends of a way touches no hole."""
    half = np.abs(start.rotation[:2, :2]) @ tool[:2] / 2
    places = np.array([start.position[:2], end.position[:2]])
    low, high = places.min(axis=0) - half + SAME_M, places.max(axis=0) + half - SAME_M
    return all(
        bool((hole.middle + hole.size / 2 <= low).any() or (hole.middle - hole.size / 2 >= high).any())
        for hole in holes
    )
