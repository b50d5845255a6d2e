"""Connections of clients: bounded in number and in the time that a request may take to arrive."""

from __future__ import annotations

import asyncio
from typing import Any

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

MAX_CONNECTIONS = 1000
"""The number of connections without WebSocket; one more closes the one that has been idle for longest."""
REQUEST_S = 10.0
"""How long the head of a request may take to arrive, in s."""


class BoundedConnection(H11Protocol):
    """A connection that is closed if it keeps a request waiting, or others out."""

    def __init__(self, *arguments: Any, **settings: Any) -> None:
        super().__init__(*arguments, **settings)
        self._idle_since = self.loop.time()
        self._expiry: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Take a connection; close another one if there are too many."""
        super().connection_made(transport)
        self._expect()
        if len(self.connections) > MAX_CONNECTIONS:
            _close_idlest([each for each in self.connections if isinstance(each, BoundedConnection)])

    def data_received(self, data: bytes) -> None:
        """Take what the client sends."""
        super().data_received(data)
        if self.is_idle and self.conn.their_state is h11.IDLE:
            self._expect()
        else:
            self._cancel()

    def handle_websocket_upgrade(self, event: h11.Request) -> None:
        """Hand the connection over to a WebSocket."""
        self._cancel()
        super().handle_websocket_upgrade(event)

    def on_response_complete(self) -> None:
        """Wait for the next request."""
        self._idle_since = self.loop.time()
        super().on_response_complete()

    def connection_lost(self, exc: Exception | None) -> None:
        """The connection is gone."""
        self._cancel()
        super().connection_lost(exc)

    @property
    def is_idle(self) -> bool:
        """Whether no request is answered now."""
        return self.cycle is None or self.cycle.response_complete

    @property
    def idle_since(self) -> float:
        """Since when it has been idle, in s of the event loop; infinite while a request is answered."""
        return self._idle_since if self.is_idle else float("inf")

    def close(self) -> None:
        """Close the connection."""
        self.transport.close()

    def _expect(self) -> None:
        """Close the connection unless a request arrives in time."""
        if self._expiry is None:
            self._expiry = self.loop.call_later(REQUEST_S, self.close)

    def _cancel(self) -> None:
        if self._expiry is not None:
            self._expiry.cancel()
            self._expiry = None


def _close_idlest(connections: list[BoundedConnection]) -> None:
    """Close the connection that has been idle for longest; none if all are busy."""
    idlest = min(connections, key=lambda each: each.idle_since)
    if idlest.is_idle:
        idlest.close()
