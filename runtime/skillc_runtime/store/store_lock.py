"""The lock of a store on disk: shared by its users, or exclusive."""

from __future__ import annotations

import fcntl
import os
from pathlib import Path

from skillc_runtime.cancellation import CancelToken
from skillc_runtime.store.file_lock import lock_file, try_lock_file
from skillc_runtime.world.state.transactions import StoreError

PATIENCE_S = 30.0
"""How long to wait for another user of a store."""


class StoreLock:
    """A file lock on a store; the system releases it when the process ends."""

    def __init__(self, path: Path) -> None:
        """Open the lock file, which needs read access only; OSError when that is not possible."""
        self._path = path
        self._file = os.open(path, os.O_RDONLY | os.O_CLOEXEC)

    def acquire_shared(self, cancel: CancelToken) -> None:
        """Take the lock shared; StoreError when another process holds it exclusively for PATIENCE_S."""
        if not lock_file(self._file, fcntl.LOCK_SH, cancel.limited(PATIENCE_S)):
            raise StoreError(f"{self._path.parent} is locked by {self.describe_others()}; try again later")

    def try_exclusive(self) -> bool:
        """Try to take the lock exclusively and return whether that succeeded; if not, no lock is held."""
        return try_lock_file(self._file, fcntl.LOCK_EX)

    def release(self) -> None:
        """Release the lock."""
        os.close(self._file)

    def describe_others(self) -> str:
        """Return the other users of the store for a message: process numbers if the system provides them."""
        return describe_holders(self._file)


def describe_holders(file: int) -> str:
    """Return the other processes that lock an open file, for a message: their numbers if the system provides them."""
    try:
        locks = Path("/proc/locks").read_text(encoding="ascii")
    except OSError:
        return "another process"
    inode = os.fstat(file).st_ino
    found = {int(words[4]) for words in map(str.split, locks.splitlines()) if words[5:6] and _inode(words[5]) == inode}
    numbers = ", ".join(map(str, sorted(found - {os.getpid(), -1})))
    return f"process {numbers}" if numbers else "another process"


def _inode(device: str) -> int:
    """Return the inode in `major:minor:inode`; -1 for other texts."""
    last = device.rpartition(":")[2]
    return int(last) if last.isdigit() else -1
