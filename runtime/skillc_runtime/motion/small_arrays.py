"""The part of numpy that places and sizes in a scene need, in plain Python, for installations without numpy.

numpy is as large as all else that checking and planning need together. Names and results are those of numpy, for
arrays of one and two dimensions of floats, integers or booleans; anything else is a ModuleNotFoundError of numpy, never
another result. Two differences: slices are copies, and there is one type of numbers of each kind.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import product
from typing import Any, NoReturn, TypeAlias

from skillc_runtime.motion.small_array import ndarray, refuse

Like: TypeAlias = "ndarray | float | Sequence[Any]"

pi, inf = math.pi, math.inf
float64, bool_, uint8 = float, bool, int


class generic:  # noqa: N801 - the name that numpy has
    """The base of numpy's scalars, of which there are none here."""


class linalg:  # noqa: N801 - the name that numpy has
    """What `numpy.linalg` has."""

    @staticmethod
    def norm(values: Like, axis: int | None = None) -> Any:
        """Return the length of a vector, or of each row of a matrix (`axis` 1) or each column (`axis` 0)."""
        return array(values).reduced(lambda numbers: math.sqrt(sum(each * each for each in numbers)), axis)


def __getattr__(name: str) -> NoReturn:
    if name.startswith("__"):
        raise AttributeError(name)
    refuse(name)


def array(values: Like, dtype: type | None = None) -> ndarray:
    """Return an array of numbers, or of rows of numbers."""
    return ndarray.of(values, dtype)


asarray = array


def zeros(shape: int | tuple[int, ...], dtype: type = float) -> ndarray:
    """Return an array of zeros."""
    return full(shape, dtype(0))


def ones(shape: int | tuple[int, ...]) -> ndarray:
    """Return an array of ones."""
    return full(shape, 1.0)


empty = zeros


def full(shape: int | tuple[int, ...], value: float) -> ndarray:
    """Return an array of one number `value`, in any unit."""
    size = (shape,) if isinstance(shape, int) else tuple(shape)
    return ndarray([value] * math.prod(size), size)


def eye(count: int) -> ndarray:
    """Return the identity (n, n)."""
    return diag([1.0] * count)


def diag(values: Like) -> ndarray:
    """Return the matrix (n, n) with these numbers on its diagonal."""
    numbers = array(values).tolist()
    return array(
        [[each if row == column else 0.0 for column in range(len(numbers))] for row, each in enumerate(numbers)]
    )


def arange(start: int, stop: int | None = None) -> ndarray:
    """Return the whole numbers from a start, or from 0, up to the one before `stop`."""
    return array(list(range(start) if stop is None else range(start, stop)))


def linspace(start: float, stop: float, count: int, endpoint: bool = True) -> ndarray:
    """Return evenly spaced numbers (count,) from `start` to `stop`, in any unit."""
    steps = count - 1 if endpoint else count
    found = [start + i * ((stop - start) / steps) if steps else start for i in range(count)]
    return array([float(each) for each in ([*found[:-1], stop] if endpoint and count > 1 else found)])


def column_stack(columns: Iterable[Like]) -> ndarray:
    """Return the matrix with these columns."""
    return array([list(row) for row in zip(*(array(each).tolist() for each in columns), strict=True)])


def vstack(parts: Iterable[Like]) -> ndarray:
    """Return the rows of several matrices as one."""
    return array([row for each in parts for row in array(each).tolist()])


def concatenate(parts: Iterable[Like]) -> ndarray:
    """Return the numbers, or the rows, of several arrays as one."""
    return vstack(parts)


def append(values: Like, more: Like) -> ndarray:
    """Return all numbers of two arrays in one of one dimension."""
    return array([*array(values).ravel(), *ndarray.flat(more)])


def ndindex(*counts: Any) -> Iterator[tuple[int, ...]]:
    """Yield the indices of all elements of a shape."""
    yield from product(*(range(int(each)) for each in counts))


def cross(a: Like, b: Like) -> ndarray:
    """Return the cross product (3,) of vectors (3,)."""
    one, other = array(a), array(b)
    if one.shape != (3,) or other.shape != (3,):
        refuse("cross")
    (u, v, w), (x, y, z) = one.tolist(), other.tolist()
    return array([v * z - w * y, w * x - u * z, u * y - v * x])


def dot(a: Like, b: Like) -> Any:
    """Return the product of matrices and vectors."""
    return array(a) @ array(b)


def array_equal(a: Like, b: Like) -> bool:
    """Whether two arrays have the same shape and numbers."""
    one, other = array(a), array(b)
    return one.shape == other.shape and one.tolist() == other.tolist()


def all(values: Like) -> bool:
    """Whether no number is zero."""
    return bool(array(values).all()) if isinstance(values, ndarray | list | tuple) else bool(values)


def any(values: Like) -> bool:
    """Whether a number is not zero."""
    return bool(array(values).any()) if isinstance(values, ndarray | list | tuple) else bool(values)


def argmin(values: Like) -> int:
    """Return the index of the first least number of an array of one dimension."""
    numbers = array(values).tolist()
    return min(range(len(numbers)), key=numbers.__getitem__)


def flatnonzero(values: ndarray) -> ndarray:
    """Return the indices of the numbers that are not zero, of an array of one dimension."""
    return array([index for index, each in enumerate(values.ravel()) if each])


def ptp(values: Like, axis: int | None = None) -> Any:
    """Return the difference of the greatest and the least number."""
    return array(values).max(axis) - array(values).min(axis)


def clip(values: Like, low: float, high: float) -> Any:
    """Return numbers within limits `low` and `high`, in any unit."""
    return minimum(maximum(values, low), high)


def maximum(a: Like, b: Like) -> Any:
    """Return the greater number of each pair."""
    return _pairwise(max, a, b)


def minimum(a: Like, b: Like) -> Any:
    """Return the smaller number of each pair."""
    return _pairwise(min, a, b)


def hypot(a: Like, b: Like) -> Any:
    """Return the length of each pair."""
    return _pairwise(math.hypot, a, b)


def _pairwise(function: Callable[[Any, Any], Any], a: Like, b: Like) -> Any:
    if isinstance(a, ndarray | list | tuple):
        return array(a).combined(b, function)
    if isinstance(b, ndarray | list | tuple):
        return array(b).combined(a, lambda one, other: function(other, one))
    return function(a, b)


def _each(function: Callable[[float], Any]) -> Callable[[Like], Any]:
    def apply(values: Any) -> Any:
        if isinstance(values, ndarray | list | tuple):
            found = array(values)
            return ndarray([function(each) for each in found.ravel()], found.shape)
        return function(values)

    return apply


abs = _each(operator.abs)
sqrt, sin, cos, arccos, degrees = map(_each, (math.sqrt, math.sin, math.cos, math.acos, math.degrees))
isfinite = _each(math.isfinite)
floor = _each(lambda each: float(math.floor(each)))
