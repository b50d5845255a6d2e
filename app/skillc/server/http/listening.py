"""Where a server listens: for this machine, with TLS, or behind a proxy, and under which names."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from dataclasses import dataclass
from ipaddress import ip_address
from pathlib import Path
from typing import Literal

from skillc.errors import RequestError, ServiceError

LOCAL_NAMES = ("localhost", "127.0.0.1", "[::1]")
ANY = ("0.0.0.0", "::")


@dataclass(frozen=True, slots=True)
class Certificate:
    """The files of a TLS certificate with its chain, and of its key, both PEM."""

    chain: Path
    key: Path


@dataclass(frozen=True, slots=True)
class Listening:
    """The address of a server. `names` are the other names, with port if it is not the default one, that clients use.

    `proxy` is the address of a proxy that all requests come from, and that encrypts. RequestError for an address of
    other machines without TLS or a proxy, and for one that has no name.
    """

    host: str
    port: int
    names: tuple[str, ...] = ()
    certificate: Certificate | None = None
    proxy: str | None = None

    def __post_init__(self) -> None:
        if self.proxy is not None and not _is_address(self.proxy):
            raise RequestError(
                f"--behind-proxy {self.proxy}: give the address that the requests of the proxy come from"
            )
        if not self.is_local and self.certificate is None and self.proxy is None:
            raise RequestError(
                f"{self.host} is not an address of this machine alone, and tokens would be sent there in the clear: "
                "give a certificate with --tls-cert and --tls-key, or name the proxy that encrypts with --behind-proxy"
            )
        if self.host in ANY and not self.names:
            raise RequestError(f"with {self.host} give the name that clients use with --host")

    @property
    def is_local(self) -> bool:
        """Whether only this machine can connect."""
        return self.host in LOCAL_NAMES or (_is_address(self.host) and ip_address(self.host).is_loopback)

    @property
    def scheme(self) -> Literal["http", "https"]:
        """The scheme of its addresses."""
        return "https" if self.certificate is not None else "http"

    def find_address(self, port: int) -> str:
        """Return the address that clients use, without a path, if the server listens to `port`."""
        if self.host in ANY:
            name = self.names[0]
            return f"{self.scheme}://{name if ':' in name else f'{name}:{port}'}"
        return f"{self.scheme}://{f'[{self.host}]' if ':' in self.host else self.host}:{port}"

    def find_hosts(self, port: int) -> frozenset[str]:
        """Return what the header `Host` of a request may be, if the server listens to `port`."""
        return frozenset(each.lower() for each in self._list_hosts(port))

    def _list_hosts(self, port: int) -> Iterator[str]:
        for name in (*LOCAL_NAMES, self.host, *self.names):
            yield name
            yield f"{name}:{port}"

    def open_socket(self) -> socket.socket:
        """Return a socket that listens; ServiceError if the address cannot be used."""
        family = socket.AF_INET6 if ":" in self.host else socket.AF_INET
        try:
            listener = socket.create_server((self.host, self.port), family=family)
        except OSError as error:
            raise ServiceError(f"{self.host}:{self.port} cannot be listened to: {error.strerror}") from error
        listener.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)  # asyncio sets it only for explicit TCP sockets
        return listener


def _is_address(text: str) -> bool:
    try:
        ip_address(text)
    except ValueError:
        return False
    return True
