"""Starts the process that watches this one, and lets it end this one while the interpreter is blocked."""

from __future__ import annotations

import ctypes
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from math import inf
from pathlib import Path

from skillc_runtime.platforms import watchdog_program

IS_WATCHED = sys.platform != "win32"
"""Whether a run can be watched: Windows has no signal that ends a process whose interpreter is blocked."""


def start_watchdog(
    folder: Path, timeout_s: float, ending: str, quiet: bool, environment: dict[str, str]
) -> subprocess.Popen[bytes]:
    """Start a process that watches this one; OSError if that fails.

    It ends this one if a tick takes longer than `timeout_s`, 0 for no limit, and lets the module `ending` write its
    end. A byte on its standard input dismisses it. With `quiet` it writes nothing to the standard output.
    """
    return subprocess.Popen(
        (
            *(sys.executable, "-I", "-S", watchdog_program.__file__),
            *(str(os.getpid()), str(folder), str(timeout_s or inf), ending),
        ),
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL if quiet else None,
        start_new_session=True,
        env=environment,
    )


@contextmanager
def exiting_at_sigquit() -> Iterator[None]:
    """Make `_exit` of the C library the handler of SIGQUIT, so that it works while the interpreter is blocked.

    The handler is called with the number of the signal, which is 3, the exit code of a failed task.
    """
    if sys.platform == "win32":
        raise RuntimeError("Windows has no SIGQUIT")
    c = ctypes.CDLL(None)
    c.signal.restype, c.signal.argtypes = ctypes.c_void_p, (ctypes.c_int, ctypes.c_void_p)
    before = c.signal(signal.SIGQUIT, ctypes.cast(c._exit, ctypes.c_void_p))
    try:
        yield
    finally:
        c.signal(signal.SIGQUIT, before)
