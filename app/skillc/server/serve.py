"""Runs a server: opens its state, keeps its cells going, and serves the API until it is ended."""

from __future__ import annotations

import asyncio
import os
import signal
import socket
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from types import FrameType

import uvicorn
from starlette.types import ASGIApp

from skillc.cells.database import DatabaseError
from skillc.contract.api.endpoint import PREFIX
from skillc.contract.cell import CellStatus
from skillc.contract.messages import StatusChanged
from skillc.contract.values import MAX_BODY_BYTES
from skillc.errors import ServiceError
from skillc.server.app import Application
from skillc.server.cells import ServedCells
from skillc.server.context import ServerContext
from skillc.server.http.connections import BoundedConnection
from skillc.server.http.listening import Listening
from skillc.server.hub import EventHub, News
from skillc.server.log import log
from skillc.server.orders.submitting import keep_submitting
from skillc.server.state import ServerState, announced
from skillc.server.supervisor import CellSupervisor
from skillc.services.reporting.reporter import Reporter
from skillc_dsl.garbage import exempt_from_gc
from skillc_runtime.platforms.open_files import raise_open_files_limit
from skillc_runtime.platforms.signals import handling
from skillc_runtime.world.state.transactions import StoreError

SHELL_OFFSET = 128
"""Shells give a process that was ended by a signal this exit code plus the signal's number."""


WAITING = 2048
"""How many connections wait in the system until they are taken; `backlog` of the settings are taken at once."""

KEEP_ALIVE_S = 30
GRACE_S = 5
"""How long open requests may take when the server ends, in s."""
OWNER_ONLY = 0o077
"""What is masked in the permissions of all that the server and its cells write."""
TAKEN_AT_ONCE = 50
"""How many new connections are taken at once, before requests of others are read."""


def serve(
    served: ServedCells,
    listening: Listening,
    state: AbstractContextManager[ServerState],
    reporter: Reporter,
    on_ready: Callable[[ServerContext, str], None] | None = None,
) -> None:
    """Serve cells until SIGINT, SIGTERM or SIGHUP, and let them come to rest then; say how the cells are.

    `on_ready` is called in a thread, with the address without a path, as soon as that takes connections.

    ServiceError if the address or the state folder cannot be used.
    """
    raise_open_files_limit()
    os.umask(OWNER_ONLY)
    try:
        with state as opened, listening.open_socket() as listener:
            asyncio.run(_serve(opened, served, listening, listener, reporter, on_ready))
    except (DatabaseError, StoreError) as error:
        raise ServiceError(str(error)) from error
    except OSError as error:
        raise ServiceError(f"the state folder cannot be used: {error}") from error


async def _serve(
    state: ServerState,
    served: ServedCells,
    listening: Listening,
    listener: socket.socket,
    reporter: Reporter,
    on_ready: Callable[[ServerContext, str], None] | None,
) -> None:
    port = listener.getsockname()[1]
    hub = EventHub()

    def publish(news: News) -> None:
        hub.publish(news)
        if isinstance(news, StatusChanged):
            reporter.say(_describe(news.status))
            log("cell", cell=news.status.name, state=news.status.state, reason=news.status.reason)

    cells = {each.name: CellSupervisor(each, publish, served.find_library(each).find_obstacle) for each in served.cells}
    context = ServerContext(state, cells, hub, served.libraries)
    application = Application(context, listening.find_hosts(port), listening.proxy)
    server = EndingServer(_configure(application.asgi, listening))
    address = listening.find_address(port)
    reporter.say(f"serving at {address}{PREFIX}; the token of the command line is in {state.token_file.resolve()}")
    going = [asyncio.create_task(each.keep_going()) for each in cells.values()]
    going += [asyncio.create_task(each.keep_up(context.find_users(each))) for each in served.libraries]
    going += [asyncio.create_task(keep_submitting(context, each)) for each in cells.values()]
    if on_ready is not None:
        context.run_readers.warm()
        going.append(asyncio.create_task(asyncio.to_thread(on_ready, context, address)))
    exempt_from_gc()
    try:
        with announced(state, address):
            await server.serve(sockets=[listener])
    finally:
        await context.jobs.close()
        context.run_readers.close()
        for task in going:
            task.cancel()
        for task in going:
            with suppress(asyncio.CancelledError):
                await task
        if server.ended_by:
            reporter.say(f"ended by {server.ended_by}: all devices are at rest")


def _configure(application: ASGIApp, listening: Listening) -> uvicorn.Config:
    """Return the settings of the HTTP server; ServiceError if the certificate cannot be used."""
    certificate = listening.certificate
    config = uvicorn.Config(
        application,
        http=BoundedConnection,
        log_config=None,
        server_header=False,
        proxy_headers=False,
        timeout_keep_alive=KEEP_ALIVE_S,
        timeout_graceful_shutdown=GRACE_S,
        backlog=TAKEN_AT_ONCE,
        ws="websockets-sansio",
        ws_max_size=2 * MAX_BODY_BYTES,
        ssl_certfile=certificate.chain if certificate else None,
        ssl_keyfile=certificate.key if certificate else None,
    )
    try:
        config.load()
    except OSError as error:  # an ssl.SSLError is one, too
        assert certificate is not None, "without a certificate nothing is read"
        raise ServiceError(
            f"{certificate.chain} and {certificate.key} are no certificate with its key: {error}"
        ) from error
    return config


def _describe(status: CellStatus) -> str:
    pace = "as fast as it computes" if status.pace is None else f"at {status.pace:g} x real time"
    return f"cell {status.name}: {status.state}, {status.reason or pace}"


class EndingServer(uvicorn.Server):
    """Ends at SIGINT, SIGTERM and SIGHUP; `ended_by` is the name of the signal. Signals that are ignored stay so."""

    ended_by = ""

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Listen; more connections may wait than are taken at once, between which requests are answered."""
        await super().startup(sockets)
        for each in sockets or ():
            each.listen(WAITING)

    @contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Handle the signals in a `with` statement, in the main thread only."""
        with handling(self._end):
            yield

    def _end(self, number: int, _frame: FrameType | None) -> None:
        if self.should_exit:
            os._exit(SHELL_OFFSET + number)
        self.should_exit, self.ended_by = True, signal.Signals(number).name
