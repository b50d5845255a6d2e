"""Where arrays are in memory, as rows of a table: a compiled function gets any number of them for the cost of one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from ctypes import CFUNCTYPE, c_bool, c_double, c_int64
from dataclasses import is_dataclass
from functools import cache
from inspect import get_annotations
from typing import Any

from msgspec import Struct

from skillc_runtime.motion.arrays import Array, np


def is_record(annotation: Any) -> bool:
    """Tell whether an annotation is a struct or a dataclass: its fields are passed, one by one."""
    return isinstance(annotation, type) and (issubclass(annotation, Struct) or is_dataclass(annotation))


@cache
def fields_of(kind: Any) -> dict[str, Any]:
    """Return the annotations of the fields of a struct or a dataclass, in their order."""
    stated: dict[str, Any] = {}
    for each in reversed(kind.__mro__):
        stated |= get_annotations(each, eval_str=True)
    return {name: stated[name] for name in kind.__match_args__}


@cache
def count_rows(annotation: Any) -> int:
    """Return how many rows of a table a parameter takes: one for each array or number."""
    if not is_record(annotation):
        return 1
    return sum(count_rows(each) for each in fields_of(annotation).values())


def list_leaves(path: str, annotation: Any) -> Iterator[tuple[str, Any]]:
    """Yield the expressions of all arrays and numbers of a parameter with their annotations, in the order of rows."""
    if not is_record(annotation):
        yield path, annotation
        return
    for name, each in fields_of(annotation).items():
        yield from list_leaves(f"{path}.{name}", each)


ROW = 5
"""Integers in a row of a table: address, rows, columns, and bytes from one row or column to the next."""


def find_place(array: Array) -> tuple[int, int, int, int, int]:
    """Return the row of an array (n,) or (n, m) in any unit; ValueError if it is not in C order.

    A vector has one column.
    """
    if not array.flags.c_contiguous:
        raise ValueError(f"memory of the shape {array.shape} is not in C order")
    rows, columns = array.shape if array.ndim == 2 else (array.size, 1)
    return array.__array_interface__["data"][0], rows, columns, 8 * columns, 8


def is_on_memory(annotations: Iterable[Any]) -> bool:
    """Tell whether a function works on memory: only its first parameter is a struct."""
    are_memory = [is_record(each) for each in annotations]
    return are_memory[:1] == [True] and not any(are_memory[1:])


def list_arrays(memory: Any) -> list[Array]:
    """Return the arrays (n,) or (n, m) in any unit of a struct, and of those in it, in the order of rows.

    Numbers are copied into new ones.

    TypeError if one is not as its annotation states.
    """
    found: list[Array] = []
    kind: type = type(memory)
    for name, annotation in fields_of(kind).items():
        value = getattr(memory, name)
        if is_record(annotation):
            found.extend(list_arrays(value))
            continue
        array = value if isinstance(value, np.ndarray) else np.asarray(value, np.float64)
        if problem := _find_problem(array, annotation, is_own=array is not value):
            raise TypeError(f"{kind.__name__}.{name} {problem}")
        found.append(array)
    return found


def _find_problem(array: Array, annotation: Any, is_own: bool) -> str | None:
    """Return why memory cannot be the array that an annotation states; a number `is_own` memory."""
    if array.dtype != (np.int64 if is_integral(annotation) else np.float64):
        return f"has elements of the type {array.dtype}"
    if annotation is float:
        return None if array.size == 1 else f"is no number but of the shape {array.shape}"
    dimensions, access = annotation.__metadata__
    if is_own or array.ndim != dimensions:
        return f"is no array with {dimensions} dimensions"
    return "cannot be written" if access == "written" and not array.flags.writeable else None


def is_integral(annotation: Any) -> bool:
    """Tell whether an annotation of an array states integers."""
    return annotation is not float and annotation.__metadata__[1] == "integers"


def call_entry(address: int, *arguments: float) -> int:
    """Call the C function at an address with integers, numbers and booleans; return its integer of 64 bits.

    Compiled functions call it without Python.
    """
    kinds: dict[type, Any] = {bool: c_bool, int: c_int64, float: c_double}
    found: int = CFUNCTYPE(c_int64, *(kinds[type(each)] for each in arguments))(address)(*arguments)
    return found
