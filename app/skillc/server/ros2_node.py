"""Runs the node of ROS 2 beside a server: a process of its own, which is a client with a token of its own."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from skillc.client.address import TOKEN_VARIABLE, URL_VARIABLE
from skillc.server.context import ServerContext

TOKEN_NAME = "ros2"
"""The name of the node's token, by which the history shows who has requested something."""
PROGRAM = "skillc.ros.process"
END_S = 5.0


@contextmanager
def ros2_node() -> Iterator[Callable[[ServerContext, str], None]]:
    """Yield what starts the node once the server takes connections; it ends with the `with` statement."""
    started: list[subprocess.Popen[bytes]] = []

    def start(server: ServerContext, address: str) -> None:
        tokens = server.state.tokens
        tokens.revoke(TOKEN_NAME)
        environment = {**os.environ, URL_VARIABLE: address, TOKEN_VARIABLE: tokens.add(TOKEN_NAME, "operate")}
        started.append(subprocess.Popen([sys.executable, "-m", PROGRAM], stdin=subprocess.PIPE, env=environment))

    try:
        yield start
    finally:
        for process in started:
            _end(process)


def _end(process: subprocess.Popen[bytes]) -> None:
    """End the node: it ends with its standard input."""
    assert process.stdin is not None
    process.stdin.close()
    try:
        process.wait(END_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()  # wait ends: it is killed
