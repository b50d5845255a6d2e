"""An array of one or two dimensions in plain Python, with the operators and methods of numpy's that scenes need."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NoReturn

Numbers = list[Any]
Shape = tuple[int, ...]


def refuse(what: str) -> NoReturn:
    """Raise ModuleNotFoundError: only numpy has this."""
    raise ModuleNotFoundError(f"{what} needs numpy", name="numpy")


class ndarray:  # noqa: N801 - the name that numpy has
    """Numbers in the order of rows, (n,) or (m, n)."""

    __slots__ = ("_numbers", "shape")

    def __init__(self, numbers: Numbers, shape: Shape) -> None:
        if len(shape) not in (1, 2):
            refuse(f"an array of {len(shape)} dimensions")
        self._numbers, self.shape = numbers, shape

    @staticmethod
    def of(values: Any, dtype: type | None = None) -> ndarray:
        """Return a copy of numbers, or of rows of numbers."""
        if isinstance(values, ndarray):
            found = values.copy()
        else:
            parts = list(values) if not isinstance(values, int | float) else refuse("an array of no dimension")
            rows = [each.tolist() if isinstance(each, ndarray) else each for each in parts]
            found = (
                _of_rows(rows) if rows and isinstance(rows[0], list | tuple) else ndarray(_alike(rows), (len(rows),))
            )
        return found if dtype is None else found.astype(dtype)

    @staticmethod
    def flat(values: Any) -> Numbers:
        """Return the numbers of an array, a sequence or a number."""
        return [values] if isinstance(values, int | float) else ndarray.of(values)._numbers

    @property
    def size(self) -> int:
        """The number of elements."""
        return len(self._numbers)

    @property
    def ndim(self) -> int:
        """The number of dimensions."""
        return len(self.shape)

    @property
    def T(self) -> ndarray:  # noqa: N802 - the name that numpy has
        """The transposed matrix; a vector itself."""
        if len(self.shape) == 1:
            return self
        m, n = self.shape
        return ndarray([self._numbers[i * n + j] for j in range(n) for i in range(m)], (n, m))

    def tolist(self) -> Numbers:
        """Return the numbers, or the rows, as a list."""
        return self._rows() if len(self.shape) == 2 else self._numbers[:]

    def ravel(self) -> ndarray:
        """Return all numbers in one dimension."""
        return ndarray(self._numbers[:], (self.size,))

    def copy(self) -> ndarray:
        """Return an array with the same numbers."""
        return ndarray(self._numbers[:], self.shape)

    def astype(self, dtype: type) -> ndarray:
        """Return the numbers as floats, integers or booleans."""
        return ndarray([dtype(each) for each in self._numbers], self.shape)

    def reshape(self, *shape: int) -> ndarray:
        """Return the numbers in another shape; one size may be -1."""
        known = math.prod(each for each in shape if each != -1)
        return ndarray(self._numbers[:], tuple(self.size // known if each == -1 else each for each in shape))

    def setflags(self, write: bool) -> None:
        """Do nothing: who writes to an array that others have is found where there is numpy."""

    def max(self, axis: int | None = None) -> Any:
        """Return the greatest number, of all or along an axis."""
        return self.reduced(max, axis)

    def min(self, axis: int | None = None) -> Any:
        """Return the least number, of all or along an axis."""
        return self.reduced(min, axis)

    def sum(self, axis: int | None = None) -> Any:
        """Return the sum, of all or along an axis."""
        return self.reduced(sum, axis)

    def mean(self, axis: int | None = None) -> Any:
        """Return the mean, of all or along an axis."""
        return self.reduced(lambda numbers: sum(numbers) / len(numbers), axis)

    def all(self, axis: int | None = None) -> Any:
        """Return whether no number is zero, of all or along an axis."""
        return self.reduced(all, axis)

    def any(self, axis: int | None = None) -> Any:
        """Return whether a number is not zero, of all or along an axis."""
        return self.reduced(any, axis)

    def reduced(self, function: Callable[[Numbers], Any], axis: int | None) -> Any:
        """Return what a function gives for all numbers, or an array of what it gives along an axis."""
        if axis is None or len(self.shape) == 1:
            return function(self._numbers)
        lines = self._rows() if axis in (1, -1) else self.T._rows()
        return ndarray([function(each) for each in lines], (len(lines),))

    def combined(self, other: Any, function: Callable[[Any, Any], Any]) -> ndarray:
        """Return what a function gives for each pair of numbers, with the shapes matched as numpy does."""
        if isinstance(other, int | float):
            return ndarray([function(each, other) for each in self._numbers], self.shape)
        if not isinstance(other, ndarray):
            other = ndarray.of(other)
        if self.shape == other.shape:
            return ndarray(list(map(function, self._numbers, other._numbers)), self.shape)
        (m, n), (p, q) = ((1, *self.shape)[-2:], (1, *other.shape)[-2:])
        if (m != p and 1 not in (m, p)) or (n != q and 1 not in (n, q)):
            raise ValueError(f"arrays of the shapes {self.shape} and {other.shape} do not match")
        rows, columns = (p if m == 1 else m), (q if n == 1 else n)
        found = [
            function(self._numbers[i % m * n + j % n], other._numbers[i % p * q + j % q])
            for i in range(rows)
            for j in range(columns)
        ]
        both = len(self.shape) == 2 or len(other.shape) == 2
        return ndarray(found, (rows, columns) if both else (columns,))

    def __len__(self) -> int:
        return self.shape[0]

    def __iter__(self) -> Iterator[Any]:
        if len(self.shape) == 1:
            return iter(self._numbers)
        return iter([ndarray(row, (len(row),)) for row in self._rows()])

    def __getitem__(self, at: Any) -> Any:
        if len(self.shape) == 1:
            if isinstance(at, tuple):
                return self._as_matrix(*at)
            return self._numbers[at] if isinstance(at, int) else self._taken(_indices(at, self.size))
        spots, shape = self._spots(at)
        return ndarray([self._numbers[each] for each in spots], shape) if shape else self._numbers[spots[0]]

    def __setitem__(self, at: Any, value: Any) -> None:
        spots = self._spots(at)[0] if len(self.shape) == 2 else list(_indices(at, self.size))
        numbers = [value] * len(spots) if isinstance(value, int | float) else ndarray.flat(value)
        for spot, number in zip(spots, numbers, strict=True):
            self._numbers[spot] = number

    def _taken(self, indices: Sequence[int]) -> ndarray:
        return ndarray([self._numbers[each] for each in indices], (len(indices),))

    def _spots(self, at: Any) -> tuple[list[int], Shape]:
        """Return where the numbers of a part of a matrix are, and the shape of the part, () for a single number."""
        rows, columns = at if isinstance(at, tuple) else (at, slice(None))
        m, n = self.shape
        i, j = _indices(rows, m), _indices(columns, n)
        shape = tuple(len(found) for index, found in ((rows, i), (columns, j)) if not isinstance(index, int))
        return [row * n + column for row in i for column in j], shape

    def _as_matrix(self, first: object, second: object) -> ndarray:
        """Return a vector as a matrix of one row, v[None, :], or of one column, v[:, None]."""
        match first, second:
            case None, slice(start=None, stop=None, step=None):
                return ndarray(self._numbers[:], (1, self.size))
            case slice(start=None, stop=None, step=None), None:
                return ndarray(self._numbers[:], (self.size, 1))
            case _:
                refuse("this index")

    def __matmul__(self, other: ndarray | Sequence[float]) -> Any:
        right = other if isinstance(other, ndarray) else ndarray.of(other)
        lines = self._rows() if len(self.shape) == 2 else [self._numbers]
        columns = right.T._rows() if len(right.shape) == 2 else [right._numbers]
        if len(lines[0] if lines else ()) != len(columns[0] if columns else ()):
            raise ValueError(f"arrays of the shapes {self.shape} and {right.shape} have no product")
        found = [sum(map(operator.mul, line, column)) for line in lines for column in columns]
        shape = (*self.shape[:-1], *right.shape[1:])
        return ndarray(found, shape) if shape else found[0]

    def __rmatmul__(self, other: Sequence[float]) -> Any:
        return ndarray.of(other) @ self

    def __neg__(self) -> ndarray:
        return ndarray([-each for each in self._numbers], self.shape)

    def __abs__(self) -> ndarray:
        return ndarray([abs(each) for each in self._numbers], self.shape)

    def __invert__(self) -> ndarray:
        return ndarray([not each for each in self._numbers], self.shape)

    def __bool__(self) -> bool:
        if self.size != 1:
            raise ValueError("an array of several numbers is neither true nor false")
        return bool(self._numbers[0])

    def __float__(self) -> float:
        return float(self.item())

    def item(self) -> Any:
        """Return the only number."""
        (number,) = self._numbers
        return number

    def _rows(self) -> list[Numbers]:
        n = self.shape[1]
        return [self._numbers[i * n : (i + 1) * n] for i in range(self.shape[0])]

    def __repr__(self) -> str:
        return f"array({self.tolist()})"

    __hash__ = None  # type: ignore[assignment]


def _divide(a: float, b: float) -> float:
    if b:
        return a / b
    return math.nan if not a or math.isnan(a) else math.copysign(math.inf, a) * math.copysign(1.0, b)


def _operators() -> Iterator[tuple[str, Callable[[Any, Any], Any]]]:
    for name in ("add", "sub", "mul", "mod", "pow", "lt", "le", "gt", "ge", "eq", "ne"):
        yield name, getattr(operator, name)
    yield from (("truediv", _divide), ("and", operator.and_), ("or", operator.or_))


def _define(name: str, function: Callable[[Any, Any], Any]) -> None:
    def forwards(self: ndarray, other: Any) -> ndarray:
        return self.combined(other, function)

    def backwards(self: ndarray, other: Any) -> ndarray:
        return self.combined(other, lambda one, another: function(another, one))

    setattr(ndarray, f"__{name}__", forwards)
    if name not in ("lt", "le", "gt", "ge", "eq", "ne"):
        setattr(ndarray, f"__r{name}__", backwards)


for _name, _function in _operators():
    _define(_name, _function)


def _alike(numbers: Numbers) -> Numbers:
    """Return numbers as floats if one of them is; numbers only."""
    if not all(isinstance(each, int | float) for each in numbers):
        refuse("an array of anything but numbers")
    return list(map(float, numbers)) if any(isinstance(each, float) for each in numbers) else numbers


def _of_rows(rows: list[Numbers]) -> ndarray:
    lengths = {len(each) for each in rows}
    if len(lengths) != 1:
        raise ValueError("the rows of an array have the same length")
    return ndarray(_alike([each for row in rows for each in row]), (len(rows), *lengths))


def _indices(at: Any, count: int) -> Sequence[int]:
    """Return the indices that an integer, a slice, a list of indices or an array of booleans stands for."""
    if isinstance(at, int):
        return (range(count)[at],)
    if isinstance(at, slice):
        return range(count)[at]
    if not isinstance(at, ndarray | list):
        refuse("this index")
    marks = ndarray.flat(at)
    if marks and all(isinstance(each, bool) for each in marks):
        return [index for index, taken in zip(range(count), marks, strict=True) if taken]
    return [range(count)[each] for each in marks]
