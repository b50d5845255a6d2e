"""The priority of this process among those that want the processor."""

from __future__ import annotations

import os
import sys


def lower_priority(niceness: int) -> None:
    """Let other processes come first by so many steps of Unix, where the system has them."""
    if sys.platform != "win32":
        os.nice(niceness)
