"""Samples of signals in a few bytes each: columns are quantised, and stored as differences of their values."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np
import numpy.typing as npt

from skillc_runtime.motion.pose import Array

FORMAT = 1
"""Raised with every change of the blocks; it is in the metadata of their channel."""

QUANTA = {"rad": 1e-6, "rad/s": 1e-4, "m": 1e-6, "m/s": 1e-4, "N": 1e-3, "N m": 1e-4}
"""The step of the values of a unit."""

NO_UNIT = 1e-6
"""The step of values without a unit: those of unit quaternions."""

LARGEST = 2.0**40
"""Values with more steps than this are stored as they are."""

MAX_ROWS = 1 << 16
Integers = npt.NDArray[np.int64]


class Column(msgspec.Struct, frozen=True, array_like=True):
    """The values of a signal in a block.

    With a `width` of 1, 2, 4 or 8 bytes `data` has the differences of order `order`, 1 or 2, of the values in steps of
    `quantum`. They are zigzag numbers, little-endian, all lowest bytes first; `first` are the `order` values before.
    With a width of 0 it has the values as float64, little-endian.
    """

    quantum: float
    width: int
    order: int
    first: tuple[int, ...]
    data: bytes


class SignalBlock(msgspec.Struct, frozen=True):
    """Samples that are `period_ns` apart, from `first_ns` of the cell's time on; a column for each signal."""

    first_ns: int
    period_ns: int
    rows: int
    columns: tuple[Column, ...]


def encode_columns(rows: Array, units: Sequence[str]) -> tuple[Column, ...]:
    """Encode rows (n, m) of signals with these m units."""
    quanta = np.array([QUANTA.get(unit, NO_UNIT) for unit in units])
    steps = rows / quanta
    is_whole = (np.abs(steps) < LARGEST).all(axis=0)
    whole = np.rint(np.where(is_whole, steps, 0.0)).astype(np.int64)
    once = np.diff(whole, axis=0)
    twice = np.diff(once, axis=0)
    is_smooth = np.abs(twice).sum(axis=0) < np.abs(once[1:]).sum(axis=0)
    by_order = {1: _zigzag(once), 2: _zigzag(twice)}
    columns = []
    for number, quantum in enumerate(quanta.tolist()):
        if not is_whole[number]:
            columns.append(Column(quantum, 0, 0, (), rows[:, number].astype("<f8").tobytes()))
            continue
        order = 2 if is_smooth[number] else 1
        first = tuple(int(each[0, number]) for each in (whole, once)[:order])
        values, largest = by_order[order]
        columns.append(_pack(quantum, order, first, values[number], largest[number]))
    return tuple(columns)


def _zigzag(differences: Integers) -> tuple[npt.NDArray[np.uint64], list[int]]:
    """Return differences (n, m) as zigzag numbers (m, n), and the largest of each column."""
    numbers = ((differences << 1) ^ (differences >> 63)).view(np.uint64)
    return np.ascontiguousarray(numbers.T), numbers.max(axis=0, initial=0).tolist()


def _pack(quantum: float, order: int, first: tuple[int, ...], numbers: npt.NDArray[np.uint64], largest: int) -> Column:
    width = next(each for each in (1, 2, 4, 8) if largest < 1 << 8 * each)
    planes = numbers.astype(f"<u{width}").view(np.uint8).reshape(-1, width).T
    return Column(quantum, width, order, first, planes.tobytes())


def decode_columns(block: SignalBlock) -> Array:
    """Return the rows (n, m) of a block; ValueError if it is damaged."""
    if not 0 < block.rows <= MAX_ROWS:
        raise ValueError(f"a block of {block.rows} samples")
    return np.stack([_decode_column(each, block.rows) for each in block.columns], axis=1)


def _decode_column(column: Column, rows: int) -> Array:
    if column.width == 0:
        return _require(np.frombuffer(column.data, "<f8"), rows)
    if column.width not in (1, 2, 4, 8) or column.order not in (1, 2) or len(column.first) != column.order:
        raise ValueError("a column of an unknown form")
    planes = np.frombuffer(column.data, np.uint8).reshape(column.width, -1)
    zigzag = np.ascontiguousarray(planes.T).view(f"<u{column.width}").ravel().astype(np.uint64)
    values: Integers = (zigzag >> np.uint64(1)).astype(np.int64) ^ -(zigzag & np.uint64(1)).astype(np.int64)
    for before in reversed(column.first):
        values = np.cumsum(np.concatenate([np.array([before]), values]))
    return _require(np.asarray(values * column.quantum, np.float64), rows)


def _require(values: Array, rows: int) -> Array:
    if len(values) != rows:
        raise ValueError(f"{len(values)} values in a block of {rows} samples")
    return values
