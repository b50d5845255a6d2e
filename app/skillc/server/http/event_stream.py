"""The WebSocket with what happens: how cells and operations are, or the events of one operation without a gap."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import asynccontextmanager, closing
from dataclasses import dataclass
from http import HTTPStatus

import msgspec
from starlette.websockets import WebSocket, WebSocketDisconnect

from skillc.cells.database import DatabaseError
from skillc.contract.job import JobChanged
from skillc.contract.messages import Happened, StatusChanged
from skillc.contract.runs.history import EventsHello
from skillc.server.access.tokens import Client
from skillc.server.context import ServerContext, open_journal
from skillc.server.http.audited_request import AuditedRequest
from skillc.server.http.authentication import make_credential, refuse_unknown
from skillc.server.hub import Listener, News
from skillc.server.problems import ApiRefusal
from skillc.server.supervisor import CellSupervisor
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.states import ENDS

REFUSED, ENDED, BROKEN, TRY_AGAIN = 1008, 1000, 1011, 1013
CLOSE_CODES = {HTTPStatus.SERVICE_UNAVAILABLE: BROKEN, HTTPStatus.TOO_MANY_REQUESTS: TRY_AGAIN}
INVALID_TOKEN = "the token is not valid"
HELLO_S = 10.0
"""How long a client may take to send its first message, in s."""
SILENCE_S = 30.0
"""After how long without news it is looked whether a token is still valid, in s."""
BATCH = 200
"""How many events are in one message at most."""


async def stream_events(server: ServerContext, socket: WebSocket) -> None:
    """Send what happens until the client is gone; the events of one operation until it has ended."""
    await socket.accept()  # wait ends: at once, since the request is there
    async with closing_refused(socket):
        with server.watchers.introducing():
            hello = msgspec.json.decode(await asyncio.wait_for(socket.receive_text(), HELLO_S), type=EventsHello)
            stream = ClientSocket(server, socket, make_credential(server, socket, hello.token))
            name = stream.introduce().name
        with server.watchers.watching(name), server.hub.listening() as listener:
            if hello.operation is None:
                await stream.send_states(listener)
            else:
                await stream.send_operation(hello.operation, hello.after, listener)


@asynccontextmanager
async def closing_refused(socket: WebSocket) -> AsyncIterator[None]:
    """Close a WebSocket with the reason why a client is refused, or why nothing more can be sent."""
    try:
        yield
    except WebSocketDisconnect:
        return
    except (TimeoutError, msgspec.DecodeError, RecursionError, KeyError):
        await socket.close(REFUSED, "the first message is no valid hello")
    except ApiRefusal as refused:
        await socket.close(CLOSE_CODES.get(refused.status, REFUSED), refused.problem.detail[:120])
    except DatabaseError:
        await socket.close(BROKEN, "the journal cannot be read")


@dataclass(frozen=True, slots=True)
class ClientSocket:
    """A WebSocket of a client, to which nothing more is sent once `find_client` does not find it any more."""

    server: ServerContext
    socket: WebSocket
    find_client: Callable[[], Client | None]

    def introduce(self) -> Client:
        """Return whose WebSocket begins; ApiRefusal (401, 429) without a valid token, which the audit log notes."""
        if (client := self.find_client()) is not None:
            return client
        refused = refuse_unknown(self.server, self.socket, INVALID_TOKEN)
        noted = AuditedRequest(self.server, self.socket)
        noted.detail = refused.problem.detail
        noted.end(refused.status)
        raise refused

    def check_client(self) -> Client:
        """Return whose WebSocket it is; ApiRefusal (401) if its token or session is not valid, or no longer."""
        client = self.find_client()
        if client is None:
            raise ApiRefusal(HTTPStatus.UNAUTHORIZED, INVALID_TOKEN)
        return client

    async def send_states(self, listener: Listener) -> None:
        """Send how everything is, and then what changes."""
        for cell in self.server.cells.values():
            await self._send([StatusChanged(status=cell.status)])
            await self._send([Happened(operation=each) for each in cell.operations.values()])
        await self._send([JobChanged(job=each) for each in self.server.jobs.store.list()])
        while True:
            await self._send(await self._wait(listener))

    async def send_operation(self, operation: str, after: int, listener: Listener) -> None:
        """Send the events of an operation after a number, without a gap: they are read from the journal."""
        while True:
            cell, found = self.server.find_operation(operation)
            envelopes = await _read_envelopes(cell, operation, after)
            if envelopes:
                after = envelopes[-1].sequence
                await self._send(envelopes)
            elif found.state in ENDS:
                return await self.socket.close(ENDED, "the operation has ended")
            else:
                await self._wait(listener)

    async def _send(self, items: Sequence[News | Envelope]) -> None:
        """Send items as one JSON array; nothing for none."""
        if items:
            self.check_client()
            await self.socket.send_text(msgspec.json.encode(items).decode())

    async def _wait(self, listener: Listener) -> list[News]:
        """Wait for news, SILENCE_S at most; WebSocketDisconnect if the client goes, or says something, before."""
        taking, leaving = asyncio.ensure_future(listener.take()), asyncio.ensure_future(self.socket.receive())
        try:
            await asyncio.wait((taking, leaving), timeout=SILENCE_S, return_when=asyncio.FIRST_COMPLETED)
            if leaving.done():
                raise WebSocketDisconnect
            self.check_client()
            return taking.result() if taking.done() else []
        finally:
            taking.cancel()
            leaving.cancel()


async def _read_envelopes(cell: CellSupervisor, operation: str, after: int) -> Sequence[Envelope]:
    with closing(open_journal(cell)) as reader:
        return await asyncio.to_thread(reader.envelopes, operation, after, BATCH)
