"""Which cells of a flat surface are clean and which are dirty, as one text, and the rectangles with the dirty ones."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import lru_cache
from itertools import groupby
from typing import Final, NamedTuple

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.layout import Patch
from skillc_runtime.motion.pose import Array, Pose

UNSEEN: Final = 0
CLEAN: Final = 1
DIRTY: Final = 2
SPARED: Final = 3
"""A cell that is not to be worked on: in a hole, in its margin, or outside of the stated patches."""

LETTERS: Final = "ucds"
"""The letters of the states."""

SURE: Final = 10
"""The confidence of what is certain, in tenths."""

NEAR_M = 0.035
"""Dirty cells with so much between them are in one rectangle."""

LEAST_M = 0.12
"""The least edge of a rectangle, where the surface is that large: a tool needs room to work."""

FORM = re.compile(r"([1-9]\d*)x([1-9]\d*)((?: [1-9]\d*[ucds]\d?)+)")

Box = tuple[float, float, float, float]
"""The least x and y and the greatest x and y of a rectangle in m."""


class DirtyCells(NamedTuple):
    """Neighbouring dirty cells of a row: its number, the first column, and the one after the last."""

    row: int
    start: int
    end: int


class DirtMap(NamedTuple):
    """Cells that divide a surface evenly, rows along y, columns along x, from the least of each, in its frame.

    state: UNSEEN, CLEAN, DIRTY or SPARED of each cell, row after row. confidence: the probability that the state is
    right, in tenths, rounded down; 0 where nothing was seen.
    """

    columns: int
    rows: int
    state: bytes
    confidence: bytes

    @property
    def clean_share(self) -> float:
        """The share of the cells to be worked on that are known to be clean; 1 if there are none."""
        return self._share(CLEAN, 1.0)

    @property
    def dirty_share(self) -> float:
        """The share of the cells to be worked on that were seen to be dirty; 0 if there are none."""
        return self._share(DIRTY, 0.0)

    def _share(self, state: int, nothing: float) -> float:
        counted = len(self.state) - self.state.count(SPARED)
        return self.state.count(state) / counted if counted else nothing


def format_dirt_map(dirt: DirtMap) -> str:
    """Return a map as text, `60x80 4700c 100d9`: columns and rows, then how many cells in a row are clean or dirty.

    A digit is the confidence in tenths; what has none is certain.
    """
    runs = (
        f"{len(list(cells))}{LETTERS[state]}{'' if state in (UNSEEN, SPARED) or sure >= SURE else sure}"
        for (state, sure), cells in groupby(zip(dirt.state, dirt.confidence, strict=True))
    )
    return f"{dirt.columns}x{dirt.rows} {' '.join(runs)}"


@lru_cache(maxsize=16)
def parse_dirt_map(text: str) -> DirtMap:
    """Return the map of a text; ValueError, saying what is wrong, if it is none."""
    if (found := FORM.fullmatch(text)) is None:
        raise ValueError("a map of dirt is written as `60x80 4700c 100d9`: columns x rows, then cells, row after row")
    columns, rows = int(found[1]), int(found[2])
    state, confidence = bytearray(), bytearray()
    for each in found[3].split():
        letter = re.search("[ucds]", each)
        assert letter is not None
        count, digit, kind = int(each[: letter.start()]), each[letter.end() :], LETTERS.index(letter[0])
        if len(state) + count > columns * rows:
            raise ValueError(f"it has more than {columns} x {rows} cells")
        state += bytes([kind]) * count
        confidence += bytes([0 if kind == UNSEEN else int(digit or SURE)]) * count
    if len(state) < columns * rows:
        raise ValueError(f"it has {len(state)} cells in place of {columns} x {rows}")
    return DirtMap(columns, rows, bytes(state), bytes(confidence))


def find_dirty_parts(dirt: DirtMap, size: tuple[float, float]) -> tuple[Patch, ...]:
    """Return rectangles along the axes of a surface, in its frame, which have all dirty cells.

    They overlap only where one around both would be larger than both together.
    size: of the surface along x and y in m.
    """
    return tuple(
        Patch(Pose(np.array([(x0 + x1) / 2, (y0 + y1) / 2, 0.0]), np.eye(3)), np.array([x1 - x0, y1 - y0]))
        for x0, y0, x1, y1 in find_dirty_boxes(dirt, size)
    )


@lru_cache(maxsize=16)
def find_dirty_boxes(dirt: DirtMap, size: tuple[float, float]) -> tuple[Box, ...]:
    """Return the same rectangles as the least and the greatest x and y in m, in the frame of the surface.

    size: of the surface along x and y in m.
    """
    edges = size[0] / dirt.columns, size[1] / dirt.rows
    groups = _group(list(_list_runs(dirt)), round(NEAR_M / edges[0]), round(NEAR_M / edges[1]))
    return tuple(_merge([_bound(each, edges, size) for each in groups]))


def area(box: Box) -> float:
    """Return the area in m^2 of a rectangle."""
    return (box[2] - box[0]) * (box[3] - box[1])


def resample(dirt: DirtMap, x: Array, y: Array, size: Array) -> Array:
    """Return the states (m, n) of the cells at points in the frame of a surface.

    x: (n,) in m.
    y: (m,) in m.
    size: (2,) of the surface in m.
    """
    state = np.frombuffer(dirt.state, dtype=np.uint8).reshape(dirt.rows, dirt.columns)
    row, column = (
        np.clip(np.floor((at / edge + 0.5) * count).astype(int), 0, count - 1)
        for at, edge, count in ((y, size[1], dirt.rows), (x, size[0], dirt.columns))
    )
    return np.asarray(state[row][:, column])


def _list_runs(dirt: DirtMap) -> Iterator[DirtyCells]:
    for row in range(dirt.rows):
        cells, column = dirt.state[row * dirt.columns : (row + 1) * dirt.columns], 0
        for state, group in groupby(cells):
            start, column = column, column + len(list(group))
            if state == DIRTY:
                yield DirtyCells(row, start, column)


def _group(runs: list[DirtyCells], near_columns: int, near_rows: int) -> Iterable[list[DirtyCells]]:
    """Return runs in groups: those with at most so many columns and rows between them, directly or by others."""
    group_of = list(range(len(runs)))

    def find(number: int) -> int:
        while group_of[number] != number:
            group_of[number] = group_of[group_of[number]]
            number = group_of[number]
        return number

    first = 0
    for number, run in enumerate(runs):
        while runs[first].row < run.row - near_rows - 1:
            first += 1
        for other in range(first, number):
            if runs[other].start <= run.end + near_columns and run.start <= runs[other].end + near_columns:
                group_of[find(other)] = find(number)
    groups: dict[int, list[DirtyCells]] = {}
    for number, run in enumerate(runs):
        groups.setdefault(find(number), []).append(run)
    return groups.values()


def _bound(runs: list[DirtyCells], edges: tuple[float, float], size: tuple[float, float]) -> Box:
    """Return the rectangle around runs of cells with edges in m, wide enough, within the surface."""
    x = _widen(min(each.start for each in runs) * edges[0], max(each.end for each in runs) * edges[0], size[0])
    y = _widen(runs[0].row * edges[1], (max(each.row for each in runs) + 1) * edges[1], size[1])
    return x[0] - size[0] / 2, y[0] - size[1] / 2, x[1] - size[0] / 2, y[1] - size[1] / 2


def _widen(low: float, high: float, length: float) -> tuple[float, float]:
    short = max(0.0, LEAST_M - (high - low)) / 2
    low, high = low - short, high + short
    shift = max(0.0, -low) - max(0.0, high - length)
    return max(0.0, low + shift), min(length, high + shift)


def _merge(boxes: list[Box]) -> list[Box]:
    """Return boxes of which two that overlap are one, if that is no more to work on."""
    separate: list[Box] = []
    while boxes:
        one = boxes.pop()
        other = next((each for each in separate if area(_join(one, each)) <= area(one) + area(each)), None)
        if other is None:
            separate.append(one)
            continue
        separate.remove(other)
        boxes.append(_join(one, other))
    return sorted(separate)


def _join(one: Box, other: Box) -> Box:
    return min(one[0], other[0]), min(one[1], other[1]), max(one[2], other[2]), max(one[3], other[3])
