"""Starts the robot that others simulate, and the proxy before it, each in a process of its own, on loopback."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from threading import Lock
from typing import Any

TESTS = Path(__file__).parents[2]
_numbers = count(1)


def own_address() -> str:
    """Return a loopback address that no other test uses at the same time."""
    low = os.getpid()
    return f"127.{36 + next(_numbers) % 64}.{low // 250 % 250 + 1}.{low % 250 + 1}"


def run_module(module: str, *arguments: str) -> subprocess.Popen[str]:
    """Start a module of this folder as a program that is talked to by lines."""
    command = [sys.executable, "-m", f"robots.franka.{module}", *arguments]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join((str(TESTS), os.environ.get("PYTHONPATH", "")))}
    pipe = subprocess.PIPE
    return subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True, env=environment)


class Peer:
    """A process that answers lines."""

    def __init__(self, module: str, address: str, *arguments: str) -> None:
        self.address, self._turn = address, Lock()
        self.process = run_module(module, address, *arguments)
        assert self._read() == "ready"

    def ask(self, line: str) -> Any:
        """Return the answer to a line."""
        with self._turn:
            self.tell(line)
            return json.loads(self._read())

    def tell(self, line: str) -> None:
        """Send a line that has no answer."""
        assert self.process.stdin is not None
        print(line, file=self.process.stdin, flush=True)

    def close(self) -> None:
        """End the process."""
        self.process.kill()
        self.process.wait()
        for stream in (self.process.stdin, self.process.stdout):
            if stream is not None:
                stream.close()

    def _read(self) -> str:
        assert self.process.stdout is not None
        return self.process.stdout.readline().strip()


@contextmanager
def robot(*scene: object, friction: float = 0.1) -> Iterator[Peer]:
    """Run a simulated robot with a share of its friction; `scene`: as for the program, if there is something around."""
    peer = Peer("peer", own_address(), str(friction), *map(str, scene))
    try:
        yield peer
    finally:
        peer.close()


@contextmanager
def proxy(before: Peer) -> Iterator[Peer]:
    """Run a proxy before a robot."""
    peer = Peer("proxy", own_address(), before.address)
    try:
        yield peer
    finally:
        peer.close()
