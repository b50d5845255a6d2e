"""Whole messages between two processes over a connected socket, of which neither waits for half a one."""

from __future__ import annotations

import pickle
import socket
from struct import Struct
from time import monotonic
from typing import Any

LENGTH = Struct("!I")
CHUNK = 1 << 16
SEND_S = 2.0
"""How long the other side may take to receive a message, in s."""


class MessageSocket:
    """Sends and receives values that can be pickled; EOFError once the other side has gone."""

    def __init__(self, stream: socket.socket) -> None:
        self._stream, self._data = stream, bytearray()

    def send(self, value: Any) -> None:
        """Send a value; OSError if the other side does not take it."""
        data = pickle.dumps(value)
        self._stream.settimeout(SEND_S)
        self._stream.sendall(LENGTH.pack(len(data)) + data)

    def take(self) -> Any:
        """Return the next value; None if no whole one has arrived. Nothing is waited for."""
        if not self._is_whole():
            self._receive(0.0)
        return self._next() if self._is_whole() else None

    def receive(self, wait_s: float) -> Any:
        """Return the next value; TimeoutError if none arrives within a time in s."""
        until = monotonic() + wait_s
        while not self._is_whole():
            if not self._receive(max(until - monotonic(), 1e-3)) and monotonic() >= until:
                raise TimeoutError(f"nothing has arrived in {wait_s:g} s")
        return self._next()

    def close(self) -> None:
        """End the connection."""
        self._stream.close()

    def _receive(self, wait_s: float) -> bool:
        """Take what has arrived; tell whether anything has."""
        self._stream.settimeout(wait_s)
        try:
            more = self._stream.recv(CHUNK)  # wait ends: it has the time limit of the socket
        except (BlockingIOError, TimeoutError):
            return False
        if not more:
            raise EOFError
        self._data += more
        return True

    def _is_whole(self) -> bool:
        data = self._data
        return len(data) >= LENGTH.size and len(data) >= LENGTH.size + LENGTH.unpack_from(data)[0]

    def _next(self) -> Any:
        end = LENGTH.size + LENGTH.unpack_from(self._data)[0]
        message = bytes(self._data[LENGTH.size : end])
        del self._data[:end]
        return pickle.loads(message)
