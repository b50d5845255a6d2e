"""Many watch a cell, and half of them never read: nobody else notices, and they have missed nothing when they do."""

from __future__ import annotations

import asyncio
import json
import socket
from collections.abc import Iterator
from contextlib import AsyncExitStack, ExitStack
from pathlib import Path
from typing import Any

import pytest
from websockets.asyncio.client import connect
from websockets.client import ClientProtocol
from websockets.exceptions import ConnectionClosedOK
from websockets.frames import Frame, Opcode
from websockets.uri import parse_uri

from server.running import RunningServer, serving
from waiting import LONG_S

WATCHERS, TRIPS = 50, 30
SEGMENT = 536
"""How many bytes are in a segment to a client that never reads: the system then keeps little for it on both sides."""
WRITTEN_AHEAD = 1 << 16
"""How many bytes `asyncio` takes for a client before who writes has to wait."""
TRIP = """
        Load(cart: lab:Cart-1, crate: lab:crate-0)
        Unload(cart: lab:Cart-1, crate: lab:crate-0, to: lab:Goal)
        Load(cart: lab:Cart-1, crate: lab:crate-0)
        Unload(cart: lab:Cart-1, crate: lab:crate-0, to: lab:Start)"""
TASK = f"""# A long task.

import "yard.skill"

prefix lab: <http://example.org/lab#>

task carry_to_and_fro {{
    scene "yard.ttl"
    do seq {{{TRIP * TRIPS}
    }}
}}
"""


@pytest.mark.sim
def test_fifty_who_never_read_keep_no_event_from_fifty_who_do(tmp_path: Path) -> None:
    (tmp_path / "long.skill").write_text(TASK, encoding="utf-8")
    with serving(tmp_path, takes_ms=1) as server, ExitStack() as stack:
        operation = server.submit(task="carry_to_and_fro", step=True)["id"]
        silent = [stack.enter_context(SilentWatcher(server, operation)) for _ in range(WATCHERS)]
        found = asyncio.run(read_while_it_runs(server, operation))
        every = list(range(1, server.client.get(f"/operations/{operation}").json()["events"] + 1))
        assert found == [every] * WATCHERS
        kept = sum(each.count_kept() for each in silent) / WATCHERS
        assert [each.read() for each in silent] == [every] * WATCHERS, "who reads later has missed nothing"
    needed = sum(each.received for each in silent) / WATCHERS
    assert needed > kept + 2 * WRITTEN_AHEAD, "the server had to wait for who did not read"


async def read_while_it_runs(server: RunningServer, operation: str) -> list[list[int]]:
    """Return the numbers of the events that each of those got who read from its start to its end."""
    async with AsyncExitStack() as stack:
        address = f"{server.url.replace('http', 'ws')}/events"
        readers = [await stack.enter_async_context(connect(address)) for _ in range(WATCHERS)]
        read = [asyncio.create_task(read_events(each, server.token, operation)) for each in readers]
        resume = {"type": "resume"}
        await asyncio.to_thread(server.wait_for, operation, "paused")
        await asyncio.to_thread(server.client.post, f"/operations/{operation}/commands", json=resume)
        await asyncio.to_thread(server.wait_for, operation, "succeeded")
        return await asyncio.gather(*read)


async def read_events(watcher: Any, token: str, operation: str) -> list[int]:
    """Return the numbers of the events of an operation, as they come until it has ended."""
    await watcher.send(json.dumps({"token": token, "operation": operation}))
    found = list[int]()
    try:
        while True:
            found += find_numbers(await asyncio.wait_for(watcher.recv(), LONG_S))
    except ConnectionClosedOK:
        return found


def find_numbers(message: str | bytes) -> list[int]:
    """Return the numbers of the events in a message."""
    return [each["sequence"] for each in json.loads(message)]


class SilentWatcher:
    """Asks for the events of an operation, and takes nothing until `read`; `received` counts the bytes it got then."""

    def __init__(self, server: RunningServer, operation: str) -> None:
        self.received = 0
        self._hello = json.dumps({"token": server.token, "operation": operation})
        self._protocol = ClientProtocol(parse_uri(f"{server.url.replace('http', 'ws')}/events"), max_size=None)
        self._socket = socket.socket()
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1)
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_MAXSEG, SEGMENT)
        self._socket.settimeout(LONG_S)
        self._port = server.port

    def __enter__(self) -> SilentWatcher:
        self._socket.connect(("127.0.0.1", self._port))
        self._protocol.send_request(self._protocol.connect())
        self._exchange()
        self._protocol.send_text(self._hello.encode())
        self._send()
        return self

    def __exit__(self, *_: object) -> None:
        self._socket.close()

    def count_kept(self) -> int:
        """Return how many bytes the system keeps for this client, on both sides of its connection."""
        ours, theirs = self._socket.getsockname()[1], self._port
        kept = {(local, remote): sent + got for local, remote, sent, got in read_queues()}
        return kept[ours, theirs] + kept[theirs, ours]

    def read(self) -> list[int]:
        """Return the numbers of all events that wait, and of those that follow."""
        found, message = list[int](), b""
        while True:
            for event in self._protocol.events_received():
                if isinstance(event, Frame) and event.opcode in (Opcode.TEXT, Opcode.CONT):
                    message += event.data
                    if event.fin:
                        found, message = found + find_numbers(message), b""
            if self._protocol.close_expected():
                return found
            self._exchange()

    def _exchange(self) -> None:
        self._send()
        data = self._socket.recv(WRITTEN_AHEAD)
        self.received += len(data)
        self._protocol.receive_data(data) if data else self._protocol.receive_eof()

    def _send(self) -> None:
        for data in self._protocol.data_to_send():
            self._socket.sendall(data)


def read_queues() -> Iterator[tuple[int, int, int, int]]:
    """Yield local and remote port of each connection of this machine, and how many bytes wait to be sent and read."""
    for line in Path("/proc/net/tcp").read_text().splitlines()[1:]:
        _, local, remote, _, queues, *_ = line.split()
        sent, got = queues.split(":")
        yield int(local.split(":")[1], 16), int(remote.split(":")[1], 16), int(sent, 16), int(got, 16)
