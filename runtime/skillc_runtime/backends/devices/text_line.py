"""A connection to a device that answers lines of text with lines of text."""

from __future__ import annotations

from socket import create_connection, socket

from skillc_runtime.devices.backend import BackendUnavailable

TIMEOUT_S = 2.0
"""How long an answer is waited for, in s."""


def split_address(address: str, port: int) -> tuple[str, int]:
    """Return host and port of an address such as `192.168.1.2` or `192.168.1.2:63352`; `port` unless it has one."""
    host, colon, number = address.rpartition(":")
    return (host, int(number)) if colon and number.isdigit() else (address, port)


class TextLine:
    """A connection, which `open` makes; OSError for all that can go wrong with it later."""

    def __init__(self, name: str, host: str, port: int) -> None:
        self._name, self._host, self._port = name, host, port
        self._socket: socket | None = None
        self._rest = b""

    def open(self, cure: str) -> None:
        """Connect; BackendUnavailable, which ends with `cure`."""
        self.close()
        try:
            self._socket = create_connection((self._host, self._port), timeout=TIMEOUT_S)
        except OSError as error:
            raise BackendUnavailable(
                f"{self._name} does not answer at {self._host}, port {self._port} ({error}): {cure}"
            ) from error

    def send(self, line: str) -> None:
        """Send a line."""
        if self._socket is None:
            raise OSError("not connected")
        self._socket.sendall(line.encode() + b"\n")

    def receive(self) -> str:
        """Return the next line, without its end; a device that sends no line ends closes each answer by a pause."""
        if self._socket is None:
            raise OSError("not connected")
        while b"\n" not in self._rest:
            part = self._socket.recv(1024)  # wait ends: after the timeout of the socket
            if not part:
                raise OSError("the connection was closed")
            self._rest += part
        line, _, self._rest = self._rest.partition(b"\n")
        return line.decode(errors="replace").strip()

    def receive_word(self) -> str:
        """Return an answer that has no line end: all that has arrived, at least one byte."""
        if self._socket is None:
            raise OSError("not connected")
        part = self._socket.recv(1024)  # wait ends: after the timeout of the socket
        if not part:
            raise OSError("the connection was closed")
        return part.decode(errors="replace").strip()

    def close(self) -> None:
        """Disconnect."""
        if self._socket is not None:
            self._socket.close()
        self._socket, self._rest = None, b""
