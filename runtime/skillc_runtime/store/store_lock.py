"""The lock of a store on disk: shared by its users, or exclusive."""

from __future__ import annotations

import os
from pathlib import Path

from skillc_runtime.cancellation import CancelToken
from skillc_runtime.platforms.file_locks import HAS_SHARED_LOCKS, find_holders, try_lock
from skillc_runtime.store.file_lock import lock_file
from skillc_runtime.world.state.transactions import StoreError

PATIENCE_S = 30.0
"""How long to wait for another user of a store."""


class StoreLock:
    """A file lock on a store; the system releases it when the process ends."""

    def __init__(self, path: Path) -> None:
        """Open the lock file, which needs read access only; OSError when that is not possible.

        StoreError on systems without shared locks.
        """
        if not HAS_SHARED_LOCKS:
            raise StoreError("a store in a folder needs file locks that Windows does not have; use a SPARQL server")
        self._path = path
        self._file = os.open(path, os.O_RDONLY)

    def acquire_shared(self, cancel: CancelToken) -> None:
        """Take the lock shared; StoreError when another process holds it exclusively for PATIENCE_S."""
        if not lock_file(self._file, True, cancel.limited(PATIENCE_S)):
            raise StoreError(f"{self._path.parent} is locked by {self.describe_others()}; try again later")

    def try_exclusive(self) -> bool:
        """Try to take the lock exclusively and return whether that succeeded; if not, no lock is held."""
        return try_lock(self._file)

    def release(self) -> None:
        """Release the lock."""
        os.close(self._file)

    def describe_others(self) -> str:
        """Return the other users of the store for a message: process numbers if the system provides them."""
        return describe_holders(self._file)


def describe_holders(file: int) -> str:
    """Return the other processes that lock an open file, for a message: their numbers if the system provides them."""
    numbers = ", ".join(map(str, find_holders(file)))
    return f"process {numbers}" if numbers else "another process"
