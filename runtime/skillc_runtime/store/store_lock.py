"""Who uses a store on disk: any number of processes at once, or one alone."""

from __future__ import annotations

import fcntl
import os
import time
from pathlib import Path

from skillc_runtime.world.state.transactions import StoreError

PATIENCE_S = 30.0
"""How long somebody who is alone with a store is waited for."""
PAUSE_S = 0.02


class StoreLock:
    """This process's place among the users of a store: a lock that ends with the process, however it ends."""

    def __init__(self, path: Path) -> None:
        """Open the file that the lock is on, which everybody may read; OSError when that is impossible."""
        self._path = path
        self._file = os.open(path, os.O_RDONLY | os.O_CLOEXEC)

    def acquire_shared(self) -> None:
        """Become a user, beside others; StoreError when somebody stays alone with the store for PATIENCE_S."""
        began = time.monotonic()
        while not self._lock(fcntl.LOCK_SH):
            if time.monotonic() - began > PATIENCE_S:
                raise StoreError(f"{self._path.parent} is kept busy by {self.describe_others()}; try again later")
            time.sleep(PAUSE_S)

    def try_exclusive(self) -> bool:
        """Try to become the only user and say whether that worked; if not, this is no user any more."""
        return self._lock(fcntl.LOCK_EX)

    def release(self) -> None:
        """Be no user any more."""
        os.close(self._file)

    def describe_others(self) -> str:
        """Return who else uses the store, in words: by number where the system tells."""
        try:
            locks = Path("/proc/locks").read_text(encoding="ascii")
        except OSError:
            return "another process"
        file = os.fstat(self._file).st_ino
        found = {
            int(words[4]) for words in map(str.split, locks.splitlines()) if words[5:6] and _node(words[5]) == file
        }
        numbers = ", ".join(map(str, sorted(found - {os.getpid(), -1})))
        return f"process {numbers}" if numbers else "another process"

    def _lock(self, how: int) -> bool:
        try:
            fcntl.flock(self._file, how | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True


def _node(place: str) -> int:
    """Return the number of the file in `major:minor:number`, -1 for anything else."""
    last = place.rpartition(":")[2]
    return int(last) if last.isdigit() else -1
