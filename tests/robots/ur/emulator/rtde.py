"""Port 30004: the Real-Time Data Exchange, protocol version 2."""

from __future__ import annotations

import asyncio
import struct
from collections.abc import Callable

from robots.ur.emulator.fields import INPUTS, OUTPUTS, Recipe, Value

VERSION, CONTROLLER, TEXT, DATA = ord("V"), ord("v"), ord("M"), ord("U")
SET_OUTPUTS, SET_INPUTS, START, PAUSE = ord("O"), ord("I"), ord("S"), ord("P")
RATE_HZ = 500.0


class Client:
    """One connection: what it wants to be told, and what it may set."""

    def __init__(self, writer: asyncio.StreamWriter) -> None:
        self.writer = writer
        self.outputs: Recipe | None = None
        self.every, self.started = 1, False
        self.inputs: dict[int, Recipe] = {}

    def send(self, kind: int, payload: bytes) -> None:
        """Send a package unless the client reads too slowly: a controller skips packages then."""
        if self.writer.transport.get_write_buffer_size() < 65536:
            self.writer.write(struct.pack(">HB", 3 + len(payload), kind) + payload)


class RtdePort:
    """All clients of the exchange; an input field belongs to the first client that asks for it."""

    def __init__(self, version: tuple[int, int, int, int], take: Callable[[dict[str, Value]], None]) -> None:
        """`take` gets the fields of each package of inputs."""
        self._version, self._take = version, take
        self._clients: list[Client] = []
        self._owners: dict[str, Client] = {}

    async def serve(self, host: str) -> asyncio.Server:
        """Listen."""
        return await asyncio.start_server(self._attend, host, 30004)

    def publish(self, cycle: int, values: dict[str, Value]) -> None:
        """Send what is measured in this cycle to all clients that want it now."""
        for client in self._clients:
            if client.started and client.outputs is not None and cycle % client.every == 0:
                client.send(DATA, b"\x01" + client.outputs.pack(values))

    async def _attend(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        client = Client(writer)
        self._clients.append(client)
        try:
            while True:
                size, kind = struct.unpack(">HB", await reader.readexactly(3))
                self._answer(client, kind, await reader.readexactly(size - 3))
        except (asyncio.IncompleteReadError, ConnectionError):
            pass
        finally:
            self._clients.remove(client)
            self._owners = {name: owner for name, owner in self._owners.items() if owner is not client}
            writer.close()

    def _answer(self, client: Client, kind: int, payload: bytes) -> None:
        if kind == VERSION:
            client.send(kind, b"\x01" if payload == b"\x00\x02" else b"\x00")
        elif kind == CONTROLLER:
            client.send(kind, struct.pack(">4I", *self._version))
        elif kind == SET_OUTPUTS:
            (rate,) = struct.unpack(">d", payload[:8])
            client.outputs = Recipe(_names(payload[8:]), OUTPUTS)
            client.every = max(1, round(RATE_HZ / rate))
            client.send(kind, b"\x01" + ",".join(client.outputs.types).encode())
        elif kind == SET_INPUTS:
            self._register(client, _names(payload))
        elif kind in (START, PAUSE):
            client.started = kind == START
            client.send(kind, b"\x01")
        elif kind == DATA and (recipe := client.inputs.get(payload[0])) is not None:
            self._take(recipe.unpack(payload[1:]))

    def _register(self, client: Client, names: list[str]) -> None:
        """Give fields to a client, unless another one has one of them."""
        recipe = Recipe(names, INPUTS)
        taken = [self._owners.get(name, client) is not client for name in names]
        types = ["IN_USE" if used else kind for used, kind in zip(taken, recipe.types, strict=True)]
        number = 0
        if not any(taken) and "NOT_FOUND" not in types:
            number = len(client.inputs) + 1
            client.inputs[number] = recipe
            self._owners |= dict.fromkeys(names, client)
        client.send(SET_INPUTS, bytes([number]) + ",".join(types).encode())


def _names(payload: bytes) -> list[str]:
    return [each for each in payload.decode().split(",") if each]
