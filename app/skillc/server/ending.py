"""How the HTTP server takes connections, and ends: at a signal once cells are at rest, at a second one at once."""

from __future__ import annotations

import os
import signal
import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

import uvicorn

from skillc_runtime.platforms.signals import ENDING

SHELL_OFFSET = 128
"""Shells give a process that was ended by a signal this exit code plus the signal's number."""


WAITING = 2048
"""How many connections wait in the system until they are taken; `backlog` of the settings are taken at once."""


class EndingServer(uvicorn.Server):
    """Ends at SIGINT, SIGTERM and SIGHUP; `ended_by` is the name of the signal. Signals that are ignored stay so."""

    ended_by = ""

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Listen; more connections may wait than are taken at once, between which requests are answered."""
        await super().startup(sockets)
        for each in sockets or ():
            each.listen(WAITING)

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
