"""Checks the available memory before files are read, so that the machine does not swap."""

from __future__ import annotations

from skillc_runtime.platforms.memory import available_bytes

BULK_BYTES, PLACED_BYTES = 20, 120
"""Bytes of memory for a byte of Turtle, read in bulk and read with source positions."""


class TooLittleMemory(Exception):
    """There is too little memory; the message says how much is needed and free."""


def check_available(needed: int) -> None:
    """Raise TooLittleMemory if fewer bytes are available than needed."""
    left = available_bytes()
    if left is not None and needed > left:
        raise TooLittleMemory(f"it takes about {_gigabytes(needed)} of memory, and {_gigabytes(left)} are free")


class MemoryGuard:
    """Compares the memory that an operation uses with the memory that is left."""

    def __init__(self) -> None:
        self._first = available_bytes()

    def check(self) -> None:
        """Raise TooLittleMemory if less is left than was used since the guard was created."""
        left = available_bytes()
        if left is not None and self._first is not None and left < self._first - left:
            taken = _gigabytes(self._first - left)
            raise TooLittleMemory(f"a part of it took {taken} of memory, and {_gigabytes(left)} are free")


def _gigabytes(count: int) -> str:
    return f"{count / 1e9:.2g} GB"
