"""The other end of the process that talks to a Franka Hand: orders in, what the hand measures out."""

from __future__ import annotations

import json
import subprocess
import sys
from contextlib import suppress
from threading import Event, Thread
from time import monotonic
from typing import Any, Final

PROGRAM: Final = "skillc_runtime.backends.franka.hand_process"

IDLE_SILENCE_S: Final = 3.0
MOVING_SILENCE_S: Final = 10.0
"""A hand that says nothing for longer does not answer: while nothing is to be done, and while fingers move, in s."""


class HandClient:
    """One process; it has loaded the library at once, and connects when it is ordered to."""

    def __init__(self, address: str) -> None:
        self.address = address
        self.opening_m, self.widest_m, self.error = 0.0, 0.0, ""
        self._ordered = self._done = 0
        self._said_s, self._news = monotonic(), Event()
        self._process = subprocess.Popen(
            [sys.executable, "-m", PROGRAM],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        Thread(target=self._listen, name=f"hand {address}", daemon=True).start()

    @property
    def busy(self) -> bool:
        """Whether an order is still carried out; none is without an answer."""
        return self._done < self._ordered and not self.fault

    @property
    def fault(self) -> str:
        """Why the hand cannot go on; empty while it can."""
        if self.error:
            return f"the hand at {self.address} reports an error: {self.error}"
        silent_s = monotonic() - self._said_s
        if silent_s > (MOVING_SILENCE_S if self._done < self._ordered else IDLE_SILENCE_S):
            return f"the hand at {self.address} has not answered for {silent_s:.1f} s"
        return ""

    def order(self, name: str, *arguments: Any) -> None:
        """Let the hand do something once it has done all before; returns at once."""
        self._ordered += 1
        self._said_s = monotonic()
        assert self._process.stdin is not None
        with suppress(OSError):  # The process has ended; `fault` says so.
            print(json.dumps([name, *arguments]), file=self._process.stdin, flush=True)

    def wait(self, limit_s: float) -> None:
        """Wait until all orders are carried out, or the hand cannot go on, or a time in s has passed."""
        until = monotonic() + limit_s
        while self.busy and (left := until - monotonic()) > 0.0:
            self._news.wait(left)
            self._news.clear()

    def close(self) -> None:
        """End the process, whatever it waits for."""
        self._process.kill()
        self._process.wait()  # wait ends: it is killed

    def _listen(self) -> None:
        assert self._process.stdout is not None
        for line in self._process.stdout:
            said = json.loads(line)
            self.opening_m, self.widest_m = said.get("opening", self.opening_m), said.get("max", self.widest_m)
            self.error = said.get("error", self.error)
            self._done, self._said_s = said["done"], monotonic()
            self._news.set()
        self.error = self.error or "its process has ended"
        self._news.set()
