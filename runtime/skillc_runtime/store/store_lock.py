"""The lock of a store on disk: shared by its users, or exclusive."""

from __future__ import annotations

import fcntl
import os
import time
from pathlib import Path

from skillc_runtime.world.state.transactions import StoreError

PATIENCE_S = 30.0
"""How long to wait for an exclusive user of a store."""
PAUSE_S = 0.02


class StoreLock:
    """A file lock on a store; the system releases it when the process ends."""

    def __init__(self, path: Path) -> None:
        """Open the lock file, which needs read access only; OSError when that is not possible."""
        self._path = path
        self._file = os.open(path, os.O_RDONLY | os.O_CLOEXEC)

    def acquire_shared(self) -> None:
        """Take the lock shared; StoreError when another process holds it exclusively for PATIENCE_S."""
        began = time.monotonic()
        while not self._lock(fcntl.LOCK_SH):
            if time.monotonic() - began > PATIENCE_S:
                raise StoreError(f"{self._path.parent} is locked by {self.describe_others()}; try again later")
            time.sleep(PAUSE_S)

    def try_exclusive(self) -> bool:
        """Try to take the lock exclusively and return whether that succeeded; if not, no lock is held."""
        return self._lock(fcntl.LOCK_EX)

    def release(self) -> None:
        """Release the lock."""
        os.close(self._file)

    def describe_others(self) -> str:
        """Return the other users of the store for a message: process numbers if the system provides them."""
        try:
            locks = Path("/proc/locks").read_text(encoding="ascii")
        except OSError:
            return "another process"
        file = os.fstat(self._file).st_ino
        found = {
            int(words[4]) for words in map(str.split, locks.splitlines()) if words[5:6] and _inode(words[5]) == file
        }
        numbers = ", ".join(map(str, sorted(found - {os.getpid(), -1})))
        return f"process {numbers}" if numbers else "another process"

    def _lock(self, how: int) -> bool:
        try:
            fcntl.flock(self._file, how | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True


def _inode(device: str) -> int:
    """Return the inode in `major:minor:inode`; -1 for other texts."""
    last = device.rpartition(":")[2]
    return int(last) if last.isdigit() else -1
