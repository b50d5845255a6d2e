"""A way to a server on which requests and answers are lost, delayed and garbled, as the test wants it."""

from __future__ import annotations

import socket
import struct
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from http.client import HTTPConnection
from http.server import BaseHTTPRequestHandler
from typing import Literal, get_args
from urllib.parse import urlsplit

from store.servers import serving

Fault = Literal[
    "lost request",
    "lost answer",
    "reset",
    "half an answer",
    "error 500",
    "error 503",
    "garbage",
    "page",
    "slow",
    "other rows",
    "long number",
    "echo",
    "trickle",
    "trickling head",
    "moved",
]
FAULTS: tuple[Fault, ...] = get_args(Fault)[:-3]
"""Those that pass, or may."""
SLOW_S = 0.6
"""Longer than the clients of the tests wait."""


TRICKLE_S = 0.02
"""Shorter than the clients of the tests wait for a byte."""


class Proxy:
    """`next_fault` is asked at each request what goes wrong with it; None lets it pass."""

    def __init__(self, server: str) -> None:
        self.server, self.address, self.lock = server, "", threading.Lock()
        self.next_fault: Callable[[], Fault | None] = lambda: None
        self.requests = 0
        self.authorization: str | None = None
        self.paths: list[str] = []

    def fail(self, fault: Fault, times: int) -> None:
        """Let so many requests go wrong from now on."""
        left = [fault] * times
        self.next_fault = lambda: left.pop() if left else None


@contextmanager
def proxy_to(server: str) -> Iterator[Proxy]:
    """Start a proxy to a server."""
    proxy = Proxy(server)
    handler = type("Handler", (_Handler,), {"proxy": proxy})
    with serving(handler) as proxy.address:
        yield proxy


class _Handler(BaseHTTPRequestHandler):
    protocol_version, wbufsize = "HTTP/1.1", -1
    proxy: Proxy

    def do_POST(self) -> None:
        body = self.rfile.read(int(self.headers["Content-Length"]))
        with self.proxy.lock:
            fault = self.proxy.next_fault()
            self.proxy.requests += 1
            self.proxy.paths.append(self.path)
            self.proxy.authorization = self.headers["Authorization"]
        match fault:
            case "lost request" | "reset":
                self._hang_up(fault == "reset")
            case "trickle" | "trickling head":
                self._trickle(head=fault == "trickling head")
            case "echo":
                self._answer(500, "text/plain", f"{self.path} {self.headers['Authorization']} {self.server}".encode())
            case "moved":
                self._answer(307, "text/plain", b"", ("Location", "http://ann:secret@elsewhere.invalid/x?key=secret"))
            case "other rows":
                self._answer(200, self.headers["Accept"], b'{"results": {"bindings": [{"x": {"value": "1"}}]}}')
            case "long number":
                row = b'{"n": {"value": "%s"}, "beginning": {"value": ""}, "origin": {"value": ""}}' % (b"9" * 5000)
                self._answer(200, self.headers["Accept"], b'{"results": {"bindings": [%s]}}' % row)
            case "error 500" | "error 503":
                self._answer(int(fault[-3:]), "text/plain", b"the disk is full")
            case _:
                self._passed(fault, *self._forward(body))

    def _passed(self, fault: Fault | None, status: int, kind: str, body: bytes) -> None:
        match fault:
            case "lost answer":
                self._hang_up(False)
            case "garbage":
                self._answer(200, kind, b"\x00{<nonsense")
            case "page":
                self._answer(200, "text/html", b"<h1>Welcome to the hotel</h1>")
            case "slow":
                time.sleep(SLOW_S)
                self._answer(status, kind, body)
            case _:
                self._answer(status, kind, body, half=fault == "half an answer")

    def _forward(self, body: bytes) -> tuple[int, str, bytes]:
        place = urlsplit(self.proxy.server)
        connection = HTTPConnection(place.hostname or "", place.port or 80)
        headers = {name: self.headers[name] for name in ("Content-Type", "Accept")}
        connection.request("POST", place.path.rstrip("/") + self.path.partition("?")[0], body, headers)
        response = connection.getresponse()
        content = response.read()
        connection.close()
        return response.status, response.headers["Content-Type"] or "", content

    def _trickle(self, head: bool) -> None:
        """Send a byte every so often, for ever: each of them in time."""
        self.wfile.write(b"HTTP/1.1 200 OK\r\nX: " if head else b"HTTP/1.1 200 OK\r\nContent-Length: 9999\r\n\r\n")
        self.close_connection = True
        with suppress(OSError):
            for _ in range(500):
                self.wfile.write(b"x")
                self.wfile.flush()
                time.sleep(TRICKLE_S)

    def _answer(self, status: int, kind: str, body: bytes, *headers: tuple[str, str], half: bool = False) -> None:
        self.send_response(status)
        for name, value in headers:
            self.send_header(name, value)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body[: len(body) // 2] if half else body)
        if half:
            self._hang_up(False)

    def _hang_up(self, reset: bool) -> None:
        self.close_connection = True
        self.wfile.flush()
        if reset:
            self.connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            self.connection.close()
        else:
            self.connection.shutdown(socket.SHUT_RDWR)

    def log_message(self, format: str, *args: object) -> None:
        return

    def finish(self) -> None:
        with suppress(OSError):
            super().finish()
