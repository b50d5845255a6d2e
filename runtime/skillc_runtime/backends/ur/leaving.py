"""Connections of the client library that are given up: it waits for answers that a silent controller never gives."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from threading import Thread
from time import monotonic
from typing import Any

CLOSE_S = 2.0
"""How long the end of connections is waited for: the library ends a process that ends before them."""


class Leaving:
    """Disconnects in threads that nobody waits for, except at the end."""

    def __init__(self) -> None:
        self._threads: list[Thread] = []

    def leave(self, connection: Any) -> None:
        """Disconnect."""

        def disconnect() -> None:
            with suppress(Exception):
                connection.disconnect()

        thread = Thread(target=disconnect, daemon=True)
        thread.start()
        self._threads.append(thread)

    def wait(self, seconds: float) -> None:
        """Wait until all connections have ended, or for so long."""
        until = monotonic() + seconds
        for thread in self._threads:
            thread.join(max(until - monotonic(), 0.0))


def do_within(seconds: float, act: Callable[[], None]) -> None:
    """Do something that may never end in a thread, and wait for it for so long."""
    thread = Thread(target=act, daemon=True)
    thread.start()
    thread.join(seconds)


def in_one_line(error: Exception) -> str:
    """Return the message of an error of the library in one line."""
    return " ".join(str(error).split())
