"""A network between a client and a controller, in a process of its own: it delays and holds back what passes.

`python -m robots.ur.proxy HOST TO` listens at HOST on the ports of a controller and connects to TO. Lines of JSON on
its standard input set `delay` and `jitter` in s, for each direction, `stall` (for how long nothing passes from now on)
and `hold` (whether anything passes).
"""

from __future__ import annotations

import asyncio
import json
import os
import random
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

PORTS = (29999, 30001, 30002, 30003, 30004)
PART = 65536


class Network:
    """What happens to what passes."""

    def __init__(self, there: str) -> None:
        self._there, self.delay, self.jitter = there, 0.0, 0.0
        self._open = asyncio.Event()
        self._open.set()
        self._random = random.Random(0)

    async def serve(self, host: str) -> None:
        """Listen on all ports."""
        for port in PORTS:
            await asyncio.start_server(lambda r, w, port=port: self._join(r, w, port), host, port)

    def set(self, words: dict[str, Any]) -> None:
        """Change what happens."""
        self.delay, self.jitter = words.get("delay", self.delay), words.get("jitter", self.jitter)
        if "hold" in words:
            (self._open.clear if words["hold"] else self._open.set)()
        if "stall" in words:
            self._open.clear()
            asyncio.get_running_loop().call_later(words["stall"], self._open.set)

    async def _join(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, port: int) -> None:
        there_reader, there_writer = await asyncio.open_connection(self._there, port)
        await asyncio.gather(self._pass(reader, there_writer), self._pass(there_reader, writer))

    async def _pass(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Pass on in order, each part later by the delay and up to the jitter."""
        queue: asyncio.Queue[tuple[float, bytes]] = asyncio.Queue()
        sender = asyncio.ensure_future(self._send(queue, writer))
        now = asyncio.get_running_loop().time
        with suppress(ConnectionError):
            while part := await reader.read(PART):
                queue.put_nowait((now() + self.delay + self._random.random() * self.jitter, part))
        queue.put_nowait((0.0, b""))
        await sender

    async def _send(self, queue: asyncio.Queue[tuple[float, bytes]], writer: asyncio.StreamWriter) -> None:
        now = asyncio.get_running_loop().time
        with suppress(ConnectionError):
            while True:
                due, part = await queue.get()
                await asyncio.sleep(max(due - now(), 0.0))
                await self._open.wait()
                if not part:
                    break
                writer.write(part)
        writer.close()


async def run(host: str, there: str) -> None:
    """Serve until standard input ends."""
    network, loop = Network(there), asyncio.get_running_loop()
    await network.serve(host)
    print("ready", flush=True)
    while line := await loop.run_in_executor(None, sys.stdin.readline):
        network.set(json.loads(line))
        print("done", flush=True)


class Proxy:
    """A running network, at `host`."""

    def __init__(self, host: str, process: subprocess.Popen[str]) -> None:
        self.host, self._process = host, process

    def set(self, **words: Any) -> None:
        """Change what happens; returns once it does."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps(words) + "\n")
        self._process.stdin.flush()
        assert self._process.stdout.readline().strip() == "done"


@contextmanager
def running_proxy(host: str, there: str) -> Iterator[Proxy]:
    """Run a network between `host` and a controller."""
    tests = str(Path(__file__).parents[2])
    paths = os.pathsep.join([tests, os.environ.get("PYTHONPATH", "")])
    process = subprocess.Popen(
        [sys.executable, "-m", "robots.ur.proxy", host, there],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONPATH": paths},
    )  # fmt: skip
    try:
        assert process.stdout is not None
        assert process.stdout.readline().strip() == "ready"
        yield Proxy(host, process)
    finally:
        process.kill()
        process.wait()


if __name__ == "__main__":
    asyncio.run(run(*sys.argv[1:]))
