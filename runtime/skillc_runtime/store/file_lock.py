"""Waiting for locks of files that processes share; every wait ends."""

from __future__ import annotations

import time

from skillc_runtime.cancellation import CancelToken
from skillc_runtime.platforms.file_locks import try_lock

FIRST_PAUSE_S, LONGEST_PAUSE_S = 0.0005, 0.02


def lock_file(file: int, shared: bool, cancel: CancelToken) -> bool:
    """Lock an open file; return whether that succeeded before `cancel` ended the wait."""
    pause_s = FIRST_PAUSE_S
    while not try_lock(file, shared):
        if cancel.reason is not None:
            return False
        time.sleep(pause_s)
        pause_s = min(2.0 * pause_s, LONGEST_PAUSE_S)
    return True
