"""Starts functions beside this process: as a fork, in a new interpreter or, on Windows, in a thread."""

from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Callable, Sequence
from typing import Literal, TypeAlias

from skillc_runtime.platforms.started_process import StartedProcess

StartMethod: TypeAlias = Literal["fork", "spawn", "thread"]

if sys.platform == "linux":
    DEFAULT_START: StartMethod = "fork"
elif sys.platform == "win32":
    DEFAULT_START: StartMethod = "thread"
else:
    DEFAULT_START: StartMethod = "spawn"
"""A fork starts at once; system libraries of macOS do not work in forks. A process of Windows inherits no sockets."""
INHERITS_SOCKETS = sys.platform != "win32"

_JOIN_POLL_S = 0.001


def start_process(function: Callable[[], None], start: StartMethod, files: Sequence[int]) -> StartedProcess:
    """Run a function in a new process, which inherits the file descriptors `files`, or in a thread.

    With "spawn" the function is pickled. OSError if there can be no more processes.
    """
    if sys.platform != "win32" and start != "thread":
        from skillc_runtime.platforms.unix_processes import fork, spawn

        return fork(function) if start == "fork" else spawn(function, files)
    return _Thread(function)


def join_process(process: StartedProcess, seconds: float) -> bool:
    """Wait for up to `seconds` for the end of a process; return whether it has ended."""
    end = time.monotonic() + seconds
    while process.poll() is None:
        if time.monotonic() >= end:
            return False
        time.sleep(_JOIN_POLL_S)
    return True


class _Thread:
    """A thread that ends with this process at the latest."""

    def __init__(self, function: Callable[[], None]) -> None:
        self.pid = os.getpid()
        self._abandoned = False
        self._thread = threading.Thread(target=function, daemon=True)
        self._thread.start()

    def poll(self) -> int | None:
        return None if self._thread.is_alive() and not self._abandoned else 0

    def terminate(self) -> None:
        self._abandoned = True

    def kill(self) -> None:
        self._abandoned = True
