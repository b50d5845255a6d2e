"""Runs a server: opens its state, keeps its cells going, and serves the API until it is ended."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

import uvicorn

from skillc.cells.database import DatabaseError
from skillc.cells.host import CellSettings
from skillc.cells.messages import StatusChanged
from skillc.cells.operation import CellStatus
from skillc.server.app import Application
from skillc.server.context import ServerContext
from skillc.server.endpoints import PREFIX
from skillc.server.hub import EventHub, News
from skillc.server.state import ADMIN_TOKEN, ServerState, open_state
from skillc.server.supervisor import CellSupervisor
from skillc.services.errors import RequestError, ServiceError
from skillc.services.reporting import Reporter
from skillc_runtime.world.state.transactions import StoreError

LOCAL = ("localhost", "127.0.0.1", "[::1]")
KEEP_ALIVE_S = 30
GRACE_S = 5
"""How long open requests may take when the server ends, in s."""
MAX_CONNECTIONS = 1000


def serve(cells: Iterable[CellSettings], host: str, port: int, folder: Path, reporter: Reporter) -> None:
    """Serve cells until SIGINT or SIGTERM, and let them come to rest then; say how the cells are.

    ServiceError if the address or the state folder cannot be used.
    """
    try:
        with open_state(folder) as state:
            asyncio.run(_serve(state, list(cells), _bind(host, port), host, reporter))
    except (DatabaseError, StoreError) as error:
        raise ServiceError(str(error)) from error
    except OSError as error:
        raise ServiceError(f"the state folder {folder} cannot be used: {error.strerror or error}") from error


def _bind(host: str, port: int) -> socket.socket:
    """Return a socket that listens; ServiceError if the address cannot be used."""
    if host not in LOCAL and host != "::1":
        raise RequestError(f"{host} is not an address of this machine alone: tokens would be sent there in the clear")
    try:
        return socket.create_server((host, port), family=socket.AF_INET6 if ":" in host else socket.AF_INET)
    except OSError as error:
        raise ServiceError(f"{host}:{port} cannot be listened to: {error.strerror}") from error


async def _serve(
    state: ServerState, settings: list[CellSettings], listening: socket.socket, host: str, reporter: Reporter
) -> None:
    port = listening.getsockname()[1]
    hub = EventHub()

    def publish(news: News) -> None:
        hub.publish(news)
        if isinstance(news, StatusChanged):
            reporter.say(_describe(news.status))

    cells = {each.name: CellSupervisor(each, publish) for each in settings}
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
    token = (state.folder / ADMIN_TOKEN).resolve()
    reporter.say(f"serving at http://{host}:{port}{PREFIX}; the token of the command line is in {token}")
    going = [asyncio.create_task(each.keep_going()) for each in cells.values()]
    try:
        await uvicorn.Server(config).serve(sockets=[listening])
    finally:
        for task in going:
            task.cancel()
        for task in going:
            with suppress(asyncio.CancelledError):
                await task


def _describe(status: CellStatus) -> str:
    pace = "as fast as it computes" if status.pace is None else f"at {status.pace:g} x real time"
    return f"cell {status.name}: {status.state}, {status.reason or pace}"
