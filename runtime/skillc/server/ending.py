"""How the HTTP server ends: at the first signal it lets cells come to rest, at the second one it exits at once."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

import uvicorn

from skillc_runtime.platforms.signals import ENDING

SHELL_OFFSET = 128
"""Shells give a process that was ended by a signal this exit code plus the signal's number."""


class EndingServer(uvicorn.Server):
    """Ends at SIGINT, SIGTERM and SIGHUP; `ended_by` is the name of the signal. Signals that are ignored stay so."""

    ended_by = ""

    @contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Handle the signals in a `with` statement, in the main thread only."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        before = {number: signal.getsignal(number) for number in ENDING}
        try:
            for number, former in before.items():
                if former is not signal.SIG_IGN:
                    signal.signal(number, self._end)
            yield
        finally:
            for number, former in before.items():
                signal.signal(number, former)

    def _end(self, number: int, _frame: FrameType | None) -> None:
        if self.should_exit:
            os._exit(SHELL_OFFSET + number)
        self.should_exit, self.ended_by = True, signal.Signals(number).name
