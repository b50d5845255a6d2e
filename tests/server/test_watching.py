"""Many watch a cell, and half of them never read: nobody else notices."""

from __future__ import annotations

import asyncio
import json
from contextlib import AsyncExitStack

import pytest
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosedOK

from server.running import RunningServer

WATCHERS = 50


@pytest.mark.sim
def test_fifty_who_never_read_keep_no_event_from_fifty_who_do(server: RunningServer) -> None:
    server.put_back()

    async def watch() -> tuple[dict[str, object], list[list[int]]]:
        address = f"{server.url.replace('http', 'ws')}/events"
        async with AsyncExitStack() as stack:
            for _ in range(WATCHERS):
                silent = await stack.enter_async_context(connect(address, max_queue=1))
                await silent.send(json.dumps({"token": server.token}))
            operation = await asyncio.to_thread(lambda: server.submit(task="carry_all")["id"])
            readers = [await stack.enter_async_context(connect(address)) for _ in range(WATCHERS)]
            read = [asyncio.create_task(read_events(each, server.token, operation)) for each in readers]
            ended = await asyncio.to_thread(server.wait_for, operation, "succeeded")
            return ended, await asyncio.gather(*read)

    ended, found = asyncio.run(watch())
    assert found == [list(range(1, int(str(ended["events"])) + 1))] * WATCHERS


async def read_events(socket: ClientConnection, token: str, operation: str) -> list[int]:
    """Return the numbers of the events of an operation, as they come until it has ended."""
    await socket.send(json.dumps({"token": token, "operation": operation}))
    found = list[int]()
    try:
        while True:
            found += [each["sequence"] for each in json.loads(await asyncio.wait_for(socket.recv(), 60.0))]
    except ConnectionClosedOK:
        return found
