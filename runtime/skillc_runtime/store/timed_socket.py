"""Sockets with a timeout for each wait and a limit for all waits together."""

from __future__ import annotations

import io
import socket
from typing import Any

from skillc_runtime.cancellation import CancelToken


class TimedSocket:
    """A socket for `http.client` whose reads end when `cancel` says so, however slowly the bytes arrive.

    A single wait takes at most `wait_s`.
    """

    def __init__(self, connected: socket.socket, wait_s: float, cancel: CancelToken) -> None:
        self._socket, self._wait_s = connected, wait_s
        self.cancel = cancel

    def makefile(self, *_arguments: Any) -> io.BufferedReader:
        """Return the received bytes as a file."""
        return io.BufferedReader(_Received(self._socket, self))

    def sendall(self, data: bytes) -> None:
        """Send all data; TimeoutError if that takes too long."""
        self.limit_wait()
        self._socket.sendall(data)

    def limit_wait(self) -> None:
        """Limit the next wait; TimeoutError if there is no time left."""
        left_s = self.cancel.remaining_s
        if left_s <= 0.0:
            raise TimeoutError
        self._socket.settimeout(min(left_s, self._wait_s))

    def close(self) -> None:
        """Close the connection."""
        self._socket.close()


class _Received(io.RawIOBase):
    """The received bytes; each read waits as long as the socket allows."""

    def __init__(self, connected: socket.socket, timed: TimedSocket) -> None:
        self._socket, self._timed = connected, timed

    def readable(self) -> bool:
        """Return True."""
        return True

    def readinto(self, buffer: Any) -> int:
        """Wait for bytes and put them into a buffer; TimeoutError when none arrive in time."""
        self._timed.limit_wait()
        return self._socket.recv_into(buffer)  # wait ends: after the timeout of the socket
