"""Lets this process run before all others, with its memory in place, as a control loop wants it."""

from __future__ import annotations

import gc
import os
import sys
from contextlib import suppress
from ctypes import CDLL

PRIORITY = 80
"""Above ordinary processes and below the kernel's own threads, which have 50 and 99."""

CURRENT, FUTURE = 1, 2
"""Flags of `mlockall` of Linux and macOS."""


def run_in_real_time() -> bool:
    """Ask for real-time priority and locked memory, and stop garbage collection; tell if the priority was given."""
    gc.collect()
    gc.freeze()
    gc.disable()
    if sys.platform != "linux":
        return False
    with suppress(OSError, AttributeError):
        CDLL(None).mlockall(CURRENT | FUTURE)
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(PRIORITY))
    except OSError:
        return False
    return True
