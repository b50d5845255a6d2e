"""Sends and receives frames: a length of 4 bytes, the most significant first, and so many bytes of MessagePack."""

from __future__ import annotations

import socket
import struct
from typing import Generic, TypeVar

import msgspec

LENGTH = struct.Struct(">I")
"""The length of a frame's content in bytes."""
MAX_BYTES = 2**24
"""The largest frame."""

T = TypeVar("T")


class InvalidFrame(RuntimeError):
    """What was received is no frame of this protocol."""


def encode_frame(value: object) -> bytes:
    """Return the frame of a value."""
    content = msgspec.msgpack.encode(value)
    return LENGTH.pack(len(content)) + content


def send_frame(connection: socket.socket, value: object) -> None:
    """Send a value; OSError if the other end is gone."""
    connection.sendall(encode_frame(value))


class FrameReader(Generic[T]):
    """Receives values of one type from a socket."""

    def __init__(self, connection: socket.socket, kind: type[T]) -> None:
        self._connection = connection
        self._decoder = msgspec.msgpack.Decoder(kind)

    def read(self) -> T | None:
        """Wait for a value and return it; None if the other end is closed. InvalidFrame if it is none.

        TimeoutError if the socket has a time limit and it passes before a frame begins.
        """
        header = self._receive(LENGTH.size)
        if header is None:
            return None
        (length,) = LENGTH.unpack(header)
        if length > MAX_BYTES:
            raise InvalidFrame(f"a frame of {length} bytes is too large")
        content = self._receive(length)
        try:
            return None if content is None else self._decoder.decode(content)
        except msgspec.DecodeError as error:
            raise InvalidFrame(str(error)) from error

    def _receive(self, count: int) -> bytes | None:
        """Return so many bytes; None if the other end is closed before."""
        parts, missing = list[bytes](), count
        while missing:
            part = self._connection.recv(missing)  # wait ends: with the other process, whose end closes the socket
            if not part:
                return None
            parts.append(part)
            missing -= len(part)
        return b"".join(parts)
