"""A relay to a server that cuts connections at random."""

from __future__ import annotations

import random
import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress


class CuttingRelay:
    """Passes bytes to a port of this machine and back, and cuts each connection after a random number of bytes back."""

    def __init__(self, target: int, seed: int, max_bytes: int) -> None:
        self._listener = socket.create_server(("127.0.0.1", 0))
        self._target, self._random, self._max_bytes = target, random.Random(seed), max_bytes
        self.port = int(self._listener.getsockname()[1])
        self.cuts = 0
        threading.Thread(target=self._accept, daemon=True).start()

    def close(self) -> None:
        self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()

    def _accept(self) -> None:
        with suppress(OSError):
            while True:
                client, _ = self._listener.accept()
                try:
                    server = socket.create_connection(("127.0.0.1", self._target))
                except OSError:
                    client.close()
                    continue
                budget = self._random.randrange(self._max_bytes)
                threading.Thread(target=self._pass_on, args=(client, server), daemon=True).start()
                threading.Thread(target=self._pass_back, args=(server, client, budget), daemon=True).start()

    def _pass_on(self, client: socket.socket, server: socket.socket) -> None:
        """Pass requests on, with the port of the server in their header `Host`."""
        with suppress(OSError):
            while data := client.recv(4096):
                server.sendall(data.replace(b":%d\r\n" % self.port, b":%d\r\n" % self._target))

    def _pass_back(self, server: socket.socket, client: socket.socket, budget: int) -> None:
        with suppress(OSError):
            while data := server.recv(min(4096, budget) or 1):
                client.sendall(data)
                budget -= len(data)
                if budget <= 0:
                    self.cuts += 1
                    break
        for each in (server, client):
            with suppress(OSError):
                each.shutdown(socket.SHUT_RDWR)
            each.close()


class FirstChangeCut(CuttingRelay):
    """Cuts the connection on which the first request arrives that changes something, before it is passed on."""

    def __init__(self, target: int) -> None:
        super().__init__(target, seed=0, max_bytes=10**9)

    def _pass_on(self, client: socket.socket, server: socket.socket) -> None:
        with suppress(OSError):
            while client.recv(1, socket.MSG_PEEK):
                if self.cuts == 0 and client.recv(3, socket.MSG_PEEK) in (b"POS", b"PUT"):
                    self.cuts += 1
                    server.shutdown(socket.SHUT_RDWR)
                    return
                data = client.recv(4096)
                server.sendall(data.replace(b":%d\r\n" % self.port, b":%d\r\n" % self._target))


@contextmanager
def cutting(target: int, seed: int, max_bytes: int) -> Iterator[CuttingRelay]:
    """Relay in a `with` statement, with random cuts."""
    with _open(CuttingRelay(target, seed, max_bytes)) as relay:
        yield relay


@contextmanager
def cutting_first_change(target: int) -> Iterator[CuttingRelay]:
    """Relay in a `with` statement, with one cut."""
    with _open(FirstChangeCut(target)) as relay:
        yield relay


@contextmanager
def _open(relay: CuttingRelay) -> Iterator[CuttingRelay]:
    try:
        yield relay
    finally:
        relay.close()
