"""Copies memory between addresses in compiled functions, any number of pieces in one call.

Without numba nothing of this is used.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import Any

from skillc_runtime.motion.arrays import Matrix
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.places import COMPILES


@dataclass(frozen=True, slots=True)
class Copies:
    """Pieces of memory, one a row: address to copy from, address to copy to, and how many bytes; all are exact."""

    pieces: Matrix


copy_bytes: Any = None
if COMPILES:
    _types: Any = import_module("numba").types
    _cgutils: Any = import_module("numba.core.cgutils")

    @import_module("numba.extending").intrinsic  # type: ignore[untyped-decorator]
    def _copy_bytes(typing_context: Any, source: Any, target: Any, count: Any) -> Any:
        """Copy bytes from an address to another."""

        def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            source, target = (builder.inttoptr(each, _cgutils.voidptr_t) for each in arguments[:2])
            _cgutils.raw_memcpy(builder, target, source, arguments[2], 1)
            return context.get_dummy_value()

        return _types.none(_types.int64, _types.int64, _types.int64), generate

    copy_bytes = _copy_bytes


@inlined
def copy_pieces(copies: Copies) -> None:
    """Copy all pieces in order."""
    for row in range(copies.pieces.shape[0]):
        copy_bytes(int(copies.pieces[row, 0]), int(copies.pieces[row, 1]), int(copies.pieces[row, 2]))


@compiled
def copy(copies: Copies) -> None:
    """Copy all pieces in order."""
    copy_pieces(copies)
