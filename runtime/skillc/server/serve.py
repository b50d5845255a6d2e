"""Runs a server: opens its state, keeps its cells going, and serves the API until it is ended."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

import uvicorn

from skillc.cells.host import CellSettings
from skillc.server.app import Application
from skillc.server.context import ServerContext
from skillc.server.hub import EventHub
from skillc.server.state import ServerState, open_state
from skillc.server.supervisor import CellSupervisor
from skillc.services.errors import RequestError, ServiceError

LOCAL = ("localhost", "127.0.0.1", "[::1]")
KEEP_ALIVE_S = 30
GRACE_S = 5
"""How long open requests may take when the server ends, in s."""
MAX_CONNECTIONS = 1000


def serve(cells: Iterable[CellSettings], host: str, port: int, folder: Path) -> None:
    """Serve cells until SIGINT or SIGTERM, and let them come to rest then.

    ServiceError, DatabaseError or OSError if the address or the state folder cannot be used.
    """
    with open_state(folder) as state:
        asyncio.run(_serve(state, list(cells), _bind(host, port), host))


def _bind(host: str, port: int) -> socket.socket:
    """Return a socket that listens; ServiceError if the address cannot be used."""
    if host not in LOCAL and host != "::1":
        raise RequestError(f"{host} is not an address of this machine alone: tokens would be sent there in the clear")
    try:
        return socket.create_server((host, port), family=socket.AF_INET6 if ":" in host else socket.AF_INET)
    except OSError as error:
        raise ServiceError(f"{host}:{port} cannot be listened to: {error.strerror}") from error


async def _serve(state: ServerState, settings: list[CellSettings], listening: socket.socket, host: str) -> None:
    port = listening.getsockname()[1]
    hub = EventHub()
    cells = {each.name: CellSupervisor(each, hub.publish) for each in settings}
    context = ServerContext(state, cells, hub)
    application = Application(context, frozenset(f"{name}:{port}" for name in (*LOCAL, host)))
    config = uvicorn.Config(
        application.asgi,
        log_config=None,
        server_header=False,
        proxy_headers=False,
        timeout_keep_alive=KEEP_ALIVE_S,
        timeout_graceful_shutdown=GRACE_S,
        limit_concurrency=MAX_CONNECTIONS,
        ws="websockets-sansio",
        ws_max_size=2**16,
    )
    going = [asyncio.create_task(each.keep_going()) for each in cells.values()]
    try:
        await uvicorn.Server(config).serve(sockets=[listening])
    finally:
        for task in going:
            task.cancel()
        for task in going:
            with suppress(asyncio.CancelledError):
                await task
