"""Lets a process of a test answer as promptly as the controller of a robot does, where that is allowed."""

from __future__ import annotations

import os
from contextlib import suppress

PRIORITY = 5
"""Below that of control processes."""


def run_promptly() -> None:
    """Ask for a real-time priority for this thread and those that it starts."""
    with suppress(OSError):
        os.sched_setscheduler(0, os.SCHED_RR, os.sched_param(PRIORITY))
