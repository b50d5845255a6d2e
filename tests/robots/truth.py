"""What is true behind the protocol of an emulated robot, asked over a socket, for the figures of a table."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from multiprocessing.connection import Client, Listener
from pathlib import Path
from threading import Thread
from typing import Any, cast

import numpy as np

from skillc_runtime.devices.ground_truth import GroundTruth, Recording
from skillc_runtime.motion.pose import Array


def serve_truth(file: Path, truth: Any, now: Callable[[], float]) -> None:
    """Answer questions at a socket `file`, in a thread, as long as this process runs.

    `truth` has those methods of `GroundTruth` that are asked for here, for which a simulated cell has
    `capabilities.truth`. `now` returns the time of its recordings in s.
    """
    listener = Listener(str(file), "AF_UNIX")

    def serve() -> None:
        while True:
            caller = listener.accept()
            with suppress(EOFError, OSError):
                while True:
                    name, arguments = caller.recv()
                    caller.send(now() if name == "now" else getattr(truth, name)(*arguments))

    Thread(target=serve, name="truth", daemon=True).start()


class RemoteTruth:
    """What `serve_truth` of another process offers, in the time of a cell: `now` returns that, in s."""

    def __init__(self, file: Path, now: Callable[[], float]) -> None:
        self._caller, self._now = Client(str(file), "AF_UNIX"), now
        self._times: list[tuple[float, float]] = []

    @property
    def asked(self) -> GroundTruth:
        """Itself, which has the methods that are asked for here."""
        return cast("GroundTruth", self)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return lambda *arguments: self._ask(name, *arguments)

    def compare_times(self) -> None:
        """Note which time it is there and here; to be called again and again while something is recorded."""
        self._times.append((self._ask("now"), self._now()))

    def recording(self, tool: str) -> Recording:
        """Return the recording of a tool."""
        rows = np.array(self._ask("recording", tool).rows)
        rows[:, 0] = self._in_cell(rows[:, 0])
        return Recording(rows)

    def pressing(self, button: str) -> Array:
        """Return the steps (n, 3) with a force on a button."""
        rows = np.array(self._ask("pressing", button)).reshape(-1, 3)
        rows[:, 0] = self._in_cell(rows[:, 0])
        return rows

    def _ask(self, name: str, *arguments: Any) -> Any:
        self._caller.send((name, arguments))
        return self._caller.recv()

    def _in_cell(self, times: Array) -> Array:
        there, here = np.array(self._times).T
        found: Array = np.interp(times, there, here)
        return found
