"""What holds for all tests."""

import gc
import os
import signal
import sys

from hypothesis import HealthCheck, settings

# No test depends on how fast the machine is.
settings.register_profile("skillc", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("skillc")

# Tests of, or with, what only Unix has.
if sys.platform == "win32":
    collect_ignore = ["world/test_room.py", "fuzz", "store", "operating", "cells"]


def pytest_configure() -> None:
    """Let output have no edge, caches be where tests put them, and processes that tests start listen to Ctrl-C.

    In the background, where tests may run, they would not.
    """
    os.environ.pop("COLUMNS", None)
    os.environ.pop("SKILLC_CACHE", None)
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_collection_finish() -> None:
    """Spare what was imported for the tests, which stays to the end, from being looked through for garbage."""
    gc.collect()
    gc.freeze()
