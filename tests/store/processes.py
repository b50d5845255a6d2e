"""Processes of their own that use stores, and what they tell.

They are started by a helper that has everything imported and has touched no store: what pyoxigraph has opened does not
work on in a copy of its process.
"""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable
from contextlib import suppress
from multiprocessing.forkserver import ensure_running
from pathlib import Path
from unittest.mock import patch

PROCESSES = multiprocessing.get_context("forkserver")
TESTS = str(Path(__file__).parents[1])


class Actor:
    """A process that does something to a store."""

    def __init__(self, deed: Callable[..., None], *arguments: object) -> None:
        """Start a process that calls `deed`, a function of `store.actors`, with a connection and the arguments."""
        _be_ready()
        self._ear, mouth = PROCESSES.Pipe(duplex=False)
        self.process = PROCESSES.Process(target=deed, args=(mouth, *arguments))
        self.process.start()
        mouth.close()

    def hear(self) -> str:
        """Return the next thing that the process tells, waiting for it."""
        told = self._ear.recv()
        assert isinstance(told, str)
        return told

    def told(self) -> list[str]:
        """Return everything else that the process tells until its end."""
        rest: list[str] = []
        with suppress(EOFError):
            while True:
                rest.append(self.hear())
        self.process.join()
        return rest

    def kill(self) -> None:
        """End the process at once, as `kill -9` does."""
        self.process.kill()


def _be_ready() -> None:
    """Let the helper, when it starts, import what the processes need from where the tests are."""
    PROCESSES.set_forkserver_preload(["pytest", "store.actors"])
    with patch.dict(os.environ, PYTHONPATH=os.pathsep.join([TESTS, *filter(None, [os.environ.get("PYTHONPATH")])])):
        ensure_running()
