"""The signals that ask a program to end, and what they are called."""

from __future__ import annotations

import signal
import sys

if sys.platform == "win32":
    ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGBREAK)
    FILE_TOO_LARGE: int | None = None
else:
    ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    FILE_TOO_LARGE = signal.SIGXFSZ
"""The signal that ends a program which writes more than it may; None where no signal does."""
