"""Copies memory between addresses in compiled functions, any number of pieces in one call."""

from __future__ import annotations

import ctypes
from typing import Final

import msgspec

from skillc_runtime.motion.arrays import Matrix
from skillc_runtime.motion.numerics.compiled import inlined
from skillc_runtime.motion.numerics.places import call_entry

MEMMOVE: Final = float(ctypes.cast(ctypes.memmove, ctypes.c_void_p).value or 0)
"""The address of C's function in this process."""


class Copies(msgspec.Struct, frozen=True):
    """Pieces of memory, one a row: address to copy to, address to copy from, and how many bytes; all are exact."""

    pieces: Matrix
    memmove: float = MEMMOVE


@inlined
def copy_pieces(copies: Copies) -> None:
    """Copy all pieces in order."""
    memmove = int(copies.memmove)
    for row in range(copies.pieces.shape[0]):
        call_entry(memmove, int(copies.pieces[row, 0]), int(copies.pieces[row, 1]), int(copies.pieces[row, 2]))
