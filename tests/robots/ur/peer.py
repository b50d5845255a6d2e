"""Runs an emulated controller in a process of its own, and acts on it as a person or an obstacle would."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from typing import Any

from robots.ur.emulator.panel import PORT
from skillc_ontology.catalogue import ROOT

WHITEBOARD = ROOT / "scenes/ur5e_whiteboard.ttl"
TESTS = Path(__file__).parents[2]
_hosts = count(1)


class Peer:
    """A running controller at a loopback address."""

    def __init__(self, host: str, process: subprocess.Popen[str]) -> None:
        self.host, self.process = host, process

    def do(self, what: str, **words: Any) -> dict[str, Any]:
        """Act on the robot; return what it says about itself then."""
        with socket.create_connection((self.host, PORT), 5.0) as connection:
            connection.sendall(json.dumps({"do": what, **words}).encode() + b"\n")
            answer: dict[str, Any] = json.loads(connection.makefile().readline())
        return answer

    def tell(self) -> dict[str, Any]:
        """Return what the robot says about itself."""
        return self.do("tell")

    @contextmanager
    def paused(self) -> Iterator[None]:
        """Let its process stand still meanwhile, as if a cable were cut; it runs again whatever happens."""
        self.process.send_signal(signal.SIGSTOP)
        try:
            yield
        finally:
            self.process.send_signal(signal.SIGCONT)

    def kill(self) -> None:
        """End its process, as if its power were cut."""
        self.process.kill()
        self.process.wait()


@contextmanager
def running_peer(*options: str, scene: Path = WHITEBOARD) -> Iterator[Peer]:
    """Run a controller at an address of its own."""
    host = f"127.{os.getpid() % 200 + 10}.{os.getpid() // 200 % 200 + 10}.{next(_hosts)}"
    command = [sys.executable, "-m", "robots.ur.emulator", str(scene), "--child", "--host", host, *options]
    paths = os.pathsep.join([str(TESTS), os.environ.get("PYTHONPATH", "")])
    process = subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONPATH": paths}
    )
    try:
        assert process.stdout is not None
        assert process.stdout.readline().strip() == "ready"
        yield Peer(host, process)
    finally:
        process.send_signal(signal.SIGCONT)
        process.kill()
        process.wait()
