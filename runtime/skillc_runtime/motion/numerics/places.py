"""Where arrays are in memory, as rows of a table: how a compiled function gets any number of them for the cost of one.

Without numba nothing of this is used.
"""

from __future__ import annotations

import os
from importlib import import_module
from importlib.util import find_spec
from typing import Annotated, Any

from skillc_runtime.motion.arrays import Array, np

PLACES = Annotated[Any, 2, "places"]
"""A table (n, 3) of integers: address, rows and columns of each array, which is in C order; a vector has one column."""

COMPILES: bool = os.environ.get("SKILLC_COMPILED", "1") != "0" and find_spec("numba") is not None
"""Whether functions are compiled; SKILLC_COMPILED=0 in the environment turns it off."""


def find_place(array: Array) -> tuple[int, int, int]:
    """Return the row of an array (n,) or (n, m) in any unit; ValueError if it is not in C order."""
    if not array.flags.c_contiguous:
        raise ValueError(f"memory of the shape {array.shape} is not in C order")
    rows, columns = array.shape if array.ndim == 2 else (array.size, 1)
    return array.__array_interface__["data"][0], rows, columns


vector_at: Any = None
matrix_at: Any = None
table_at: Any = None
call_entry: Any = None
if COMPILES:
    _numba: Any = import_module("numba")
    _extending: Any = import_module("numba.extending")
    _cgutils: Any = import_module("numba.core.cgutils")
    _ir: Any = import_module("llvmlite.ir")
    carray, types = _numba.carray, _numba.types

    @_extending.intrinsic  # type: ignore[untyped-decorator]
    def _pointer(typing_context: Any, address: Any) -> Any:
        """Return an address as a pointer."""

        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            return builder.inttoptr(arguments[0], context.get_value_type(types.voidptr))

        return types.voidptr(types.int64), generate

    @_extending.register_jitable  # type: ignore[untyped-decorator]
    def _vector_at(places: Any, row: int) -> Any:
        """Return the vector of a row of the table."""
        return carray(_pointer(places[row, 0]), (places[row, 1],), dtype=np.float64)

    @_extending.register_jitable  # type: ignore[untyped-decorator]
    def _matrix_at(places: Any, row: int) -> Any:
        """Return the matrix of a row of the table."""
        return carray(_pointer(places[row, 0]), (places[row, 1], places[row, 2]), dtype=np.float64)

    @_extending.register_jitable  # type: ignore[untyped-decorator]
    def _table_at(address: int, rows: int) -> Any:
        """Return the table with so many rows at an address."""
        return carray(_pointer(address), (rows, 3), dtype=np.int64)

    @_extending.intrinsic  # type: ignore[untyped-decorator]
    def _call_entry(typing_context: Any, address: Any, *arguments: Any) -> Any:
        """Call the C function at an address with integers, numbers and booleans; return its integer."""

        def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            passed = _cgutils.unpack_tuple(builder, values[1])
            kind = _ir.FunctionType(context.get_value_type(types.int64), [each.type for each in passed])
            return builder.call(builder.inttoptr(values[0], kind.as_pointer()), passed)

        return types.int64(types.int64, types.StarArgTuple(arguments)), generate

    vector_at, matrix_at, table_at = _vector_at, _matrix_at, _table_at
    call_entry = _call_entry
