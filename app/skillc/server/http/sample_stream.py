"""The WebSocket with samples of a cell. Who reads slowly gets fewer; a cell is asked once for all who watch."""

from __future__ import annotations

import asyncio
import time
from dataclasses import dataclass, field

import msgspec
from starlette.websockets import WebSocket, WebSocketDisconnect

from skillc.contract.messages import Refused, TakeSample
from skillc.contract.sample import MAX_HZ, SampleHello
from skillc.server.context import ServerContext
from skillc.server.http.authentication import make_credential
from skillc.server.http.event_stream import HELLO_S, ClientSocket, closing_refused
from skillc.server.supervisor import CellSupervisor

OFF_S = 1.0
"""How long to wait before a cell that is off is asked again."""


@dataclass(slots=True)
class SampleSource:
    """The newest sample of a cell, which is asked for one at most 1 / MAX_HZ s after the other."""

    _taken_at: float = 0.0
    _latest: bytes = b""
    _lock: asyncio.Lock = field(default_factory=asyncio.Lock)

    async def take(self, cell: CellSupervisor) -> bytes:
        """Return the newest sample as MessagePack; nothing if the cell is off, or too busy."""
        async with self._lock:  # wait ends: with the answer of the cell, or its process
            if time.monotonic() - self._taken_at >= 0.5 / MAX_HZ:
                answer = await cell.request(TakeSample())
                self._taken_at, self._latest = time.monotonic(), b"" if isinstance(answer, Refused) else answer
            return self._latest


async def stream_samples(server: ServerContext, sources: dict[str, SampleSource], socket: WebSocket) -> None:
    """Send samples of a cell until the client is gone, or its token is revoked."""
    await socket.accept()  # wait ends: at once, since the request is there
    async with closing_refused(socket):
        with server.watchers.introducing():
            hello = msgspec.json.decode(await asyncio.wait_for(socket.receive_text(), HELLO_S), type=SampleHello)
            stream = ClientSocket(server, socket, make_credential(server, socket, hello.token))
            name = stream.introduce().name
        cell = server.find_cell(hello.cell)
        source = sources.setdefault(hello.cell, SampleSource())
        with server.watchers.watching(name):
            while True:
                sample = await source.take(cell)
                stream.check_client()
                if sample:
                    await socket.send_bytes(sample)
                await _wait(socket, 1.0 / hello.rate_hz if sample else OFF_S)


async def _wait(socket: WebSocket, seconds: float) -> None:
    """Wait; WebSocketDisconnect if the client goes, or says something, before."""
    leaving = asyncio.ensure_future(socket.receive())
    try:
        await asyncio.wait((leaving,), timeout=seconds)
        if leaving.done():
            raise WebSocketDisconnect
    finally:
        leaving.cancel()
