"""Sockets with a timeout for each wait and a deadline for all waits together."""

from __future__ import annotations

import io
import socket
import time
from typing import Any


class Deadline:
    """A deadline, and the longest single wait until then."""

    def __init__(self, total_s: float, wait_s: float) -> None:
        self._ends, self._wait_s = time.monotonic() + total_s, wait_s

    def wait_s(self) -> float:
        """Return the longest allowed wait now in s; TimeoutError after the deadline."""
        left = self._ends - time.monotonic()
        if left <= 0.0:
            raise TimeoutError
        return min(left, self._wait_s)


class TimedSocket:
    """A socket for `http.client` whose reads end at a deadline, however slowly the bytes arrive."""

    def __init__(self, connected: socket.socket) -> None:
        self._socket = connected
        self.deadline: Deadline | None = None

    def makefile(self, *_arguments: Any) -> io.BufferedReader:
        """Return the received bytes as a file."""
        return io.BufferedReader(_Received(self._socket, self))

    def sendall(self, data: bytes) -> None:
        """Send all data; TimeoutError after the deadline."""
        if self.deadline is not None:
            self._socket.settimeout(self.deadline.wait_s())
        self._socket.sendall(data)

    def close(self) -> None:
        """Close the connection."""
        self._socket.close()


class _Received(io.RawIOBase):
    """The received bytes; each read waits as long as the deadline of the socket allows."""

    def __init__(self, connected: socket.socket, timed: TimedSocket) -> None:
        self._socket, self._timed = connected, timed

    def readable(self) -> bool:
        """Return True."""
        return True

    def readinto(self, buffer: Any) -> int:
        """Wait for bytes and put them into a buffer; TimeoutError when none arrive in time."""
        if self._timed.deadline is not None:
            self._socket.settimeout(self._timed.deadline.wait_s())
        return self._socket.recv_into(buffer)
