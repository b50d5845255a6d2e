"""The WebSocket with what happens: how cells and operations are, or the events of one operation without a gap."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine, Sequence
from contextlib import closing
from http import HTTPStatus
from typing import Annotated

import msgspec
from starlette.websockets import WebSocket, WebSocketDisconnect

from skillc.cells.database import DatabaseError
from skillc.cells.messages import Happened, StatusChanged
from skillc.server.context import ServerContext, open_journal
from skillc.server.hub import News
from skillc.server.problems import ApiRefusal
from skillc.server.supervisor import CellSupervisor
from skillc_runtime.execution.task_state import ENDS
from skillc_runtime.recording.envelope import Envelope

REFUSED, ENDED, BROKEN = 1008, 1000, 1011
HELLO_S = 10.0
"""How long a client may take to send its first message, in s."""
BATCH = 200
"""How many events are in one message at most."""


class Hello(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The first message of a client, as JSON: its token, and the operation whose events it wants, after a number.

    Without an operation it gets how cells and operations are.
    """

    token: Annotated[str, msgspec.Meta(max_length=200)]
    operation: Annotated[str, msgspec.Meta(max_length=200)] | None = None
    after: Annotated[int, msgspec.Meta(ge=0, le=2**63 - 1)] = 0


async def stream_events(server: ServerContext, socket: WebSocket) -> None:
    """Send what happens until the client is gone; the events of one operation until it has ended."""
    await socket.accept()  # wait ends: at once, since the request is there
    try:
        hello = msgspec.json.decode(await asyncio.wait_for(socket.receive_text(), HELLO_S), type=Hello)
        if server.state.tokens.find(hello.token) is None:
            return await socket.close(REFUSED, "the token is not valid")
        if hello.operation is None:
            await _stream_states(server, socket)
        else:
            await _stream_operation(server, socket, hello.operation, hello.after)
    except WebSocketDisconnect:
        return None
    except (TimeoutError, msgspec.DecodeError, KeyError):
        await socket.close(REFUSED, "the first message is no valid hello")
    except ApiRefusal as refused:
        code = BROKEN if refused.status is HTTPStatus.SERVICE_UNAVAILABLE else REFUSED
        await socket.close(code, refused.problem.detail[:120])
    except DatabaseError:
        await socket.close(BROKEN, "the journal cannot be read")


async def _stream_states(server: ServerContext, socket: WebSocket) -> None:
    """Send how everything is, and then what changes."""
    with server.hub.listening() as listener:
        for cell in server.cells.values():
            await _send(socket, [StatusChanged(status=cell.status)])
            await _send(socket, [Happened(operation=each) for each in cell.operations.values()])
        while True:
            await _send(socket, await _take_or_leave(socket, listener.take()))


async def _stream_operation(server: ServerContext, socket: WebSocket, operation: str, after: int) -> None:
    """Send the events of an operation after a number, without a gap: they are read from the journal."""
    with server.hub.listening() as listener:
        while True:
            cell, found = server.find_operation(operation)
            envelopes = await _read_envelopes(cell, operation, after)
            if envelopes:
                after = envelopes[-1].sequence
                await _send(socket, envelopes)
            elif found.state in ENDS:
                return await socket.close(ENDED, "the operation has ended")
            else:
                await _take_or_leave(socket, listener.take())


async def _read_envelopes(cell: CellSupervisor, operation: str, after: int) -> Sequence[Envelope]:
    with closing(open_journal(cell)) as reader:
        return await asyncio.to_thread(reader.envelopes, operation, after, BATCH)


async def _send(socket: WebSocket, items: Sequence[News | Envelope]) -> None:
    """Send items as one JSON array; nothing for none."""
    if items:
        await socket.send_text(msgspec.json.encode(items).decode())


async def _take_or_leave(socket: WebSocket, news: Coroutine[None, None, list[News]]) -> list[News]:
    """Wait for news; WebSocketDisconnect if the client goes, or says something, before there are any."""
    taking, leaving = asyncio.ensure_future(news), asyncio.ensure_future(socket.receive())
    try:
        await asyncio.wait((taking, leaving), return_when=asyncio.FIRST_COMPLETED)
        if leaving.done():
            raise WebSocketDisconnect
        return taking.result()
    finally:
        taking.cancel()
        leaving.cancel()
