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

WIDTHS = np.array([1, 2, 4, 8])
TOO_LARGE = np.array([1 << 8, 1 << 16, 1 << 32], dtype=np.uint64)
"""Bytes of a number, and from which number on each is not enough."""

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
    steps = np.divide(rows.T, quanta[:, None], order="C")
    is_whole = (steps.max(axis=1) < LARGEST) & (steps.min(axis=1) > -LARGEST)  # neither holds for NaN
    steps[~is_whole] = 0.0
    whole = np.rint(steps, out=steps).astype(np.int64)
    orders, planes = _difference(whole)
    firsts = np.diff(whole[:, :2], prepend=0).tolist()
    columns = []
    for number, (quantum, order) in enumerate(zip(quanta.tolist(), orders, strict=True)):
        if not is_whole[number]:
            columns.append(Column(quantum, 0, 0, (), rows[:, number].astype("<f8").tobytes()))
            continue
        first = tuple(firsts[number][:order])
        columns.append(Column(quantum, len(planes[number]), order, first, planes[number][:, order - 1 :].tobytes()))
    return tuple(columns)


def _difference(whole: Integers) -> tuple[list[int], list[npt.NDArray[np.uint8]]]:
    """Return the order of differences with which each of rows (m, n) takes least, and their bytes (width, n - 1).

    The first of those of order 2 is none.
    """
    chosen = np.diff(whole)
    twice = np.diff(chosen)
    is_smooth = np.abs(twice).sum(axis=1) < np.abs(chosen[:, 1:]).sum(axis=1)
    chosen[is_smooth, 1:] = twice[is_smooth]
    chosen[is_smooth, :1] = 0
    return (1 + is_smooth).tolist(), _split(np.bitwise_xor(chosen << 1, chosen >> 63, out=chosen).view(np.uint64))


def _split(zigzag: npt.NDArray[np.uint64]) -> list[npt.NDArray[np.uint8]]:
    """Return the bytes (width, n) of the numbers in each of the rows (m, n), all lowest bytes first."""
    widths = WIDTHS[np.searchsorted(TOO_LARGE, zigzag.max(axis=1, initial=0), side="right")]
    planes: dict[int, npt.NDArray[np.uint8]] = {}
    for width in WIDTHS.tolist():
        rows = np.flatnonzero(widths == width)
        parts = zigzag[rows].astype(f"<u{width}").view(np.uint8).reshape(len(rows), zigzag.shape[1], width)
        planes.update(zip(rows.tolist(), parts.transpose(0, 2, 1), strict=True))
    return [planes[row] for row in range(len(widths))]


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
