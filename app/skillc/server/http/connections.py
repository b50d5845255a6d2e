"""Connections of clients: bounded in number and in the time that a request may take to arrive."""

from __future__ import annotations

import asyncio
from collections import OrderedDict
from typing import Any, ClassVar

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

MAX_CONNECTIONS = 1000
"""The number of connections without WebSocket; with more those are closed that have been idle for longest."""
TRIM_S = 0.02
"""After which time it is looked whether there are too many, in s: a request that has arrived is read before."""
REQUEST_S = 10.0
"""How long the head of a request may take to arrive, in s."""


class BoundedConnection(H11Protocol):
    """A connection that is closed if it keeps a request waiting, or others out.

    `idle` are those of this process that answer no request that has arrived as a whole, the one that has been so for
    longest first: a request whose body does not come keeps nobody out. `counted` are all that are no WebSocket.
    """

    idle: ClassVar[OrderedDict[BoundedConnection, None]] = OrderedDict()
    counted: ClassVar[set[BoundedConnection]] = set()

    def __init__(self, *arguments: Any, **settings: Any) -> None:
        super().__init__(*arguments, **settings)
        self._expiry: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Take a connection; soon others are closed if there are too many."""
        super().connection_made(transport)
        self.idle[self] = None
        self.counted.add(self)
        self._expect()
        if len(self.counted) > MAX_CONNECTIONS:
            self.loop.call_later(TRIM_S, self._trim)

    def data_received(self, data: bytes) -> None:
        """Take what the client sends."""
        super().data_received(data)
        if self.cycle is not None and not self.cycle.response_complete:
            self._cancel()
            if self.conn.their_state is not h11.SEND_BODY:
                self.idle.pop(self, None)
        elif self.conn.their_state is h11.IDLE:
            self._expect()

    def handle_websocket_upgrade(self, event: h11.Request) -> None:
        """Hand the connection over to a WebSocket."""
        self._forget()
        super().handle_websocket_upgrade(event)

    def on_response_complete(self) -> None:
        """Wait for the next request."""
        if self in self.counted:
            self.idle[self] = None
        super().on_response_complete()

    def eof_received(self) -> None:
        """The client sends nothing more: the connection is about to be closed."""
        self._forget()
        super().eof_received()

    def connection_lost(self, exc: Exception | None) -> None:
        """The connection is gone."""
        self._forget()
        super().connection_lost(exc)

    def close(self) -> None:
        """Close the connection at once."""
        self._forget()
        self.connections.discard(self)
        self.transport.abort()

    @classmethod
    def _trim(cls) -> None:
        """Close those that have been idle for longest if there are too many."""
        while len(cls.counted) > MAX_CONNECTIONS and cls.idle:
            cls.idle.popitem(last=False)[0].close()

    def _forget(self) -> None:
        self.idle.pop(self, None)
        self.counted.discard(self)
        self._cancel()

    def _expect(self) -> None:
        """Close the connection unless a request arrives in time."""
        if self._expiry is None:
            self._expiry = self.loop.call_later(REQUEST_S, self.close)

    def _cancel(self) -> None:
        if self._expiry is not None:
            self._expiry.cancel()
            self._expiry = None
