"""A client of the Real-Time Data Exchange for what needs no real time: it reads fields, and sets others.

The client library ends the whole process if a controller goes away while its interface for inputs and outputs is open;
the process of an arm can bear that, that of the cell cannot. Protocol version 2 (guide to the Real-Time Data Exchange).
"""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from contextlib import suppress
from socket import SHUT_RDWR, create_connection, socket
from threading import Event, Lock, Thread
from typing import Final

from skillc_runtime.devices.backend import BackendUnavailable

PORT, VERSION, TIMEOUT_S = 30004, 2, 2.0

ASK_VERSION, DATA, SET_OUTPUTS, SET_INPUTS, START = ord("V"), ord("U"), ord("O"), ord("I"), ord("S")
"""Kinds of packages."""

FORMATS: Final = {"BOOL": "?", "UINT8": "B", "UINT32": "I", "UINT64": "Q", "INT32": "i", "DOUBLE": "d"}
"""How the types of fields are packed, in network byte order; fields of several numbers are not offered here."""

HEAD = struct.Struct(">HB")


class ExchangeLost(Exception):
    """The controller has closed the connection or does not answer; the message says so."""


class Exchange:
    """A connection; `fields` has the latest values of the fields that are read, by name."""

    def __init__(self, name: str, address: str, rate_hz: float, fields: Sequence[str], inputs: Sequence[str]) -> None:
        """Read `fields` so many times a second, and be the one who sets `inputs`; BackendUnavailable."""
        self._name, self._inputs = name, tuple(inputs)
        self.fields: dict[str, float] = {}
        self.fault: str | None = None
        self._turn, self._first, self._closing = Lock(), Event(), False
        refusal = f"{name} does not offer its Real-Time Data Exchange (port {PORT})"
        try:
            self._socket: socket = create_connection((address, PORT), timeout=TIMEOUT_S)
        except OSError as error:
            raise BackendUnavailable(f"{refusal}: {error}") from error
        try:
            self._open(rate_hz, tuple(fields))
        except (OSError, ExchangeLost) as error:
            self._socket.close()
            raise BackendUnavailable(f"{refusal}: {error}") from error
        self._thread = Thread(target=self._receive_all, name=f"exchange with {name}", daemon=True)
        self._thread.start()
        if not self._first.wait(TIMEOUT_S):
            self.close()
            raise BackendUnavailable(f"{name} sends no states over its Real-Time Data Exchange (port {PORT})")

    def set(self, values: Mapping[str, float]) -> None:
        """Set inputs; the others are 0, which changes nothing where a mask says so. ExchangeLost."""
        row = self._packing.pack(*(values.get(each, 0) for each in self._inputs))
        with self._turn:
            if self.fault is not None:
                raise ExchangeLost(self.fault)
            try:
                self._send(DATA, bytes([self._recipe]) + row)
            except OSError as error:
                raise ExchangeLost(f"{self._name} does not take its inputs: {error}") from error

    def close(self) -> None:
        """Disconnect at once: a socket that is closed while a thread receives from it stays open until it has."""
        self._closing = True
        with suppress(OSError):  # It is not connected any more.
            self._socket.shutdown(SHUT_RDWR)
        self._socket.close()

    def _open(self, rate_hz: float, fields: tuple[str, ...]) -> None:
        if self._ask(ASK_VERSION, struct.pack(">H", VERSION)) != b"\x01":
            raise ExchangeLost("it does not speak version 2")
        answer = self._ask(SET_OUTPUTS, struct.pack(">d", rate_hz) + ",".join(fields).encode())
        self._names, self._row = fields, self._read_types(answer, fields)
        answer = self._ask(SET_INPUTS, ",".join(self._inputs).encode())
        self._recipe, self._packing = answer[0], self._read_types(answer, self._inputs)
        if self._ask(START, b"") != b"\x01":
            raise ExchangeLost("it does not start")

    def _read_types(self, answer: bytes, names: tuple[str, ...]) -> struct.Struct:
        types = answer[1:].decode().split(",")
        for name, kind in zip(names, types, strict=False):
            if kind == "IN_USE":
                raise ExchangeLost(f"somebody else sets {name}: another program, or a fieldbus")
            if kind not in FORMATS:
                raise ExchangeLost(f"it does not know {name}")
        return struct.Struct(">" + "".join(FORMATS[kind] for kind in types))

    def _ask(self, kind: int, payload: bytes) -> bytes:
        self._send(kind, payload)
        while True:
            told, answer = self._receive()
            if told == kind:
                return answer

    def _send(self, kind: int, payload: bytes) -> None:
        self._socket.sendall(HEAD.pack(HEAD.size + len(payload), kind) + payload)

    def _receive(self) -> tuple[int, bytes]:
        size, kind = HEAD.unpack(self._receive_bytes(HEAD.size))
        return kind, self._receive_bytes(size - HEAD.size)

    def _receive_bytes(self, count: int) -> bytes:
        data = b""
        while len(data) < count:
            part = self._socket.recv(count - len(data))  # wait ends: after the timeout of the socket
            if not part:
                raise ExchangeLost("the connection was closed")
            data += part
        return data

    def _receive_all(self) -> None:
        try:
            while not self._closing:
                kind, payload = self._receive()
                if kind == DATA:
                    self.fields = dict(zip(self._names, self._row.unpack(payload[1:]), strict=True))
                    self._first.set()
        except (OSError, ExchangeLost) as error:
            self.fault = f"the inputs and outputs of {self._name} do not answer: {error}"
