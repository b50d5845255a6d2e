"""The rectangles of a surface in which cells are dirty."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.layout import Patch
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.vision.cell_map import DIRTY, CellMap
from skillc_runtime.vision.opencv import load_opencv

NEAR_CELLS = 3
"""Dirty cells with so many clean ones between them are in one rectangle."""

LEAST_M = 0.12
"""The least edge of a rectangle, where the surface is that large: a tool needs room to work."""


def find_dirty_parts(seen: CellMap) -> tuple[Patch, ...]:
    """Return rectangles along the axes of a surface, in its frame, which have all dirty cells and do not overlap."""
    dirty = (seen.state == DIRTY).astype(np.uint8)
    joined = load_opencv().dilate(dirty, np.ones((NEAR_CELLS + 1,) * 2, dtype=np.uint8))
    count, labels = load_opencv().connectedComponents(joined)
    boxes = [_bound(seen, (labels == number) & (dirty > 0)) for number in range(1, count)]
    return tuple(
        Patch(Pose(np.array([(x0 + x1) / 2, (y0 + y1) / 2, 0.0]), np.eye(3)), np.array([x1 - x0, y1 - y0]))
        for x0, y0, x1, y1 in _merge(boxes)
    )


def _bound(seen: CellMap, cells: NDArray[np.bool_]) -> tuple[float, float, float, float]:
    """Return the least and greatest x and y in m around cells, wide enough, within the surface."""
    rows, columns = np.flatnonzero(cells.any(axis=1)), np.flatnonzero(cells.any(axis=0))
    (x0, x1), (y0, y1) = (_widen(along, at) for along, at in ((seen.x, columns), (seen.y, rows)))
    return x0, y0, x1, y1


def _widen(centres: Array, at: NDArray[np.int_]) -> tuple[float, float]:
    edge = -float(centres[0]) * len(centres) / max(len(centres) - 1, 1)
    half = edge / len(centres)
    low, high = float(centres[at[0]]) - half, float(centres[at[-1]]) + half
    short = max(0.0, LEAST_M - (high - low)) / 2
    low, high = low - short, high + short
    shift = max(0.0, -edge - low) - max(0.0, high - edge)
    return max(-edge, low + shift), min(edge, high + shift)


def _merge(boxes: list[tuple[float, float, float, float]]) -> list[tuple[float, float, float, float]]:
    """Return boxes of which those that overlap are one."""
    for number, one in enumerate(boxes):
        for other in boxes[number + 1 :]:
            if one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]:
                both = min(one[0], other[0]), min(one[1], other[1]), max(one[2], other[2]), max(one[3], other[3])
                return _merge([*(each for each in boxes if each is not one and each is not other), both])
    return boxes
