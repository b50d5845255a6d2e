"""Locks of files that processes share; every wait for one ends."""

from __future__ import annotations

import fcntl
import time

from skillc_runtime.cancellation import CancelToken

FIRST_PAUSE_S, LONGEST_PAUSE_S = 0.0005, 0.02


def lock_file(file: int, how: int, cancel: CancelToken) -> bool:
    """Lock an open file with LOCK_SH or LOCK_EX; return whether that succeeded before `cancel` ended the wait."""
    pause_s = FIRST_PAUSE_S
    while not try_lock_file(file, how):
        if cancel.reason is not None:
            return False
        time.sleep(pause_s)
        pause_s = min(2.0 * pause_s, LONGEST_PAUSE_S)
    return True


def try_lock_file(file: int, how: int) -> bool:
    """Lock an open file with LOCK_SH or LOCK_EX if no other process prevents it; return whether that succeeded."""
    try:
        fcntl.flock(file, how | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True
