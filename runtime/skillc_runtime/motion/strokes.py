"""Lanes over surfaces with holes, and over several surfaces: pieces between which the tool is lifted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from skillc_runtime.motion.lanes import Direction, lanes
from skillc_runtime.motion.pose import Array, Pose

Stroke = list[Pose]
"""Poses that the tool goes through without leaving the surface."""

SHORTEST_M = 1e-6


@dataclass(frozen=True, slots=True)
class Hole:
    """A rectangle that the tool must not touch: its middle (2,) and size (2,) in m, along the surface's axes."""

    middle: Array
    size: Array


@dataclass(frozen=True, slots=True)
class Patch:
    """A surface: its pose in a common frame, its size (2,) in m, what must be left out."""

    pose: Pose
    size: Array
    holes: tuple[Hole, ...] = ()


def strokes(
    surface: Array, tool: Array, overlap: float, holes: Sequence[Hole] = (), direction: Direction = "longer"
) -> list[Stroke]:
    """Return lanes, as `lanes` has them, cut where the tool would touch a hole; in the surface frame.

    One stroke goes on from lane to lane as long as the way there touches no hole. ValueError as for `lanes`.
    """
    ends = lanes(surface, tool, overlap, direction=direction)
    found: list[Stroke] = []
    for start, end in zip(ends[::2], ends[1::2], strict=True):
        for piece in _pieces(start, end, tool, holes):
            if found and _clear(found[-1][-1], piece[0], tool, holes):
                found[-1] += piece
            else:
                found.append(piece)
    return found


def over_patches(
    patches: Sequence[Patch], tool: Array, overlap: float, start: Pose, direction: Direction = "longer"
) -> list[Stroke]:
    """Return the strokes over all patches in their common frame, each time those of the patch that begins nearest."""
    left = [[_moved(s, p.pose) for s in strokes(p.size, tool, overlap, p.holes, direction)] for p in patches]
    left = [found for found in left if found]
    ordered: list[Stroke] = []
    place = start.position
    while left:
        nearest = int(np.argmin([np.linalg.norm(found[0][0].position - place) for found in left]))
        ordered += left.pop(nearest)
        place = ordered[-1][-1].position
    return ordered


def _moved(stroke: Stroke, frame: Pose) -> Stroke:
    return [frame @ pose for pose in stroke]


def _pieces(start: Pose, end: Pose, tool: Array, holes: Sequence[Hole]) -> Iterator[Stroke]:
    """Yield what is left of a lane without the ways on which the tool would touch a hole, in the lane's direction."""
    way = end.position - start.position
    length = float(np.linalg.norm(way))
    ahead = way / length if length > SHORTEST_M else start.rotation[:, 0]
    blocked = sorted(_blocked(start, ahead, tool, hole) for hole in holes if _beside(start, ahead, tool, hole))
    free_from = 0.0
    for first, last in [*blocked, (length, np.inf)]:
        if min(first, length) >= free_from:
            yield [Pose(start.position + at * ahead, start.rotation) for at in (free_from, min(first, length))]
        free_from = max(free_from, last)


def _extents(ahead: Array, tool: Array, hole: Hole) -> Array:
    """Return how near, along and across the lane, the tool's middle may come to the hole's without touching it."""
    along = int(np.abs(ahead[:2]).argmax())
    return np.array([hole.size[along] + tool[0], hole.size[1 - along] + tool[1]]) / 2


def _beside(start: Pose, ahead: Array, tool: Array, hole: Hole) -> bool:
    """Tell whether the lane is so near to the hole that the tool touches it."""
    across = np.array([-ahead[1], ahead[0]])
    return abs(float(across @ (hole.middle - start.position[:2]))) < float(_extents(ahead, tool, hole)[1])


def _blocked(start: Pose, ahead: Array, tool: Array, hole: Hole) -> tuple[float, float]:
    """Return between which places on the lane, in m from its start, the tool touches the hole."""
    middle = float(ahead[:2] @ (hole.middle - start.position[:2]))
    reach = float(_extents(ahead, tool, hole)[0])
    return middle - reach, middle + reach


def _clear(start: Pose, end: Pose, tool: Array, holes: Sequence[Hole]) -> bool:
    """Tell whether the rectangle around the tool at both ends of a way touches no hole."""
    reach = np.abs(start.rotation[:2, :2]) @ tool[:2] / 2
    places = np.array([start.position[:2], end.position[:2]])
    low, high = places.min(axis=0) - reach, places.max(axis=0) + reach
    return all(
        bool((hole.middle + hole.size / 2 <= low).any() or (hole.middle - hole.size / 2 >= high).any())
        for hole in holes
    )
