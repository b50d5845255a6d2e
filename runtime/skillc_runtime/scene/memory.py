"""Checks the available memory before files are read, so that the machine does not swap."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

BULK_BYTES, PLACED_BYTES = 20, 120
"""Bytes of memory for a byte of Turtle, read in bulk and read with source positions."""

_MEMORY = Path("/proc/meminfo")
_LIMIT, _USED = Path("/sys/fs/cgroup/memory.max"), Path("/sys/fs/cgroup/memory.current")
_OWN = Path("/proc/self/statm")


class TooLittleMemory(Exception):
    """There is too little memory; the message says how much is needed and free."""


def available_bytes() -> int | None:
    """Return how many bytes this process can still use; None if unknown.

    Considers the machine and the container, on Linux, and the limits of the process.
    """
    known = [left for left in (_of_machine(), _of_container(), _of_limit()) if left is not None]
    return max(min(known), 0) if known else None


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


def _of_machine() -> int | None:
    with suppress(OSError, ValueError):
        fields = dict(line.split(":", 1) for line in _MEMORY.read_text("ascii").splitlines())
        return int(fields.get("MemAvailable", "").split()[0]) * 1024 if "MemAvailable" in fields else None
    return None


def _of_container() -> int | None:
    with suppress(OSError, ValueError):
        return int(_LIMIT.read_text("ascii")) - int(_USED.read_text("ascii"))
    return None


def _of_limit() -> int | None:
    try:
        import resource
    except ImportError:
        return None
    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    with suppress(OSError, ValueError):
        used = int(_OWN.read_text("ascii").split()[0]) * os.sysconf("SC_PAGE_SIZE")
        return None if limit == resource.RLIM_INFINITY else limit - used
    return None


def _gigabytes(count: int) -> str:
    return f"{count / 1e9:.2g} GB"
