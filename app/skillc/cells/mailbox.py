"""What arrives at a cell and what it reports, between the thread of its loop and those that read and write sockets."""

from __future__ import annotations

import socket
import time
from collections import deque
from collections.abc import Callable
from threading import Condition, Thread

from skillc.cells.frames import FrameReader, InvalidFrame, send_frame
from skillc.cells.tick_intervals import TickIntervals
from skillc.contract.messages import (
    Alive,
    CellAnswer,
    CellRequest,
    Happened,
    Refused,
    Report,
    StatusChanged,
    StopRequest,
)
from skillc_runtime.devices.control_report import ControlReport

MAX_WAITING = 1000
"""How many requests may wait; those beyond are refused at once."""
ALIVE_S = 0.25
"""The interval of the reports that the loop goes round, in s of wall time, whatever else is reported."""


class Outbox:
    """Reports that a thread sends. Of those about one operation, and about the cell, only the last one waits.

    So no slow reader fills it: answers are at most as many as the requests that may wait. `rounds` is how often the
    loop has gone round, `intervals` how far apart its ticks were, `arms` the reports of the
    processes that control real arms, by IRI.
    """

    def __init__(self, connection: socket.socket) -> None:
        self.rounds, self.intervals = 0, TickIntervals()
        self.arms: dict[str, ControlReport] = {}
        self._connection = connection
        self._news = Condition()
        self._answers = deque[Report]()
        self._latest: dict[str, Report] = {}
        self._closing = False
        self._alive_at = time.monotonic()
        self._thread = Thread(target=self._send, daemon=True)
        self._thread.start()

    def send(self, report: Report) -> None:
        """Send a report soon."""
        with self._news:
            match report:
                case Happened(operation=operation):
                    self._latest[operation.id] = report
                case StatusChanged():
                    self._latest[""] = report
                case _:
                    self._answers.append(report)
            self._news.notify()

    def close(self, seconds: float) -> None:
        """Send what waits, for up to `seconds`."""
        with self._news:
            self._closing = True
            self._news.notify()
        self._thread.join(seconds)

    def _send(self) -> None:
        try:
            while (reports := self._take()) is not None:
                for report in reports:
                    send_frame(self._connection, report)
        except OSError:
            return  # the other end is gone, which the inbox finds out

    def _take(self) -> list[Report] | None:
        """Wait for reports; None at the end."""
        with self._news:
            if not self._closing and not self._answers and not self._latest:
                self._news.wait(ALIVE_S)
            reports = [*self._latest.values(), *self._answers]
            self._latest.clear()
            self._answers.clear()
            if not self._closing and time.monotonic() - self._alive_at >= ALIVE_S:
                self._alive_at = time.monotonic()
                reports.append(self._describe_progress())
            return None if self._closing and not reports else reports

    def _describe_progress(self) -> Alive:
        counts, sum_s = self.intervals.counts, self.intervals.sum_s
        return Alive(rounds=self.rounds, intervals=counts, intervals_s=sum_s, arms=self.arms)


class Inbox:
    """Requests in the order of their arrival, which a thread takes from a socket.

    `closed` once the other end is gone, or sends what is no request.
    """

    def __init__(self, connection: socket.socket, outbox: Outbox) -> None:
        self.closed = False
        self._outbox = outbox
        self._news = Condition()
        self._waiting = deque[CellRequest]()
        self._woken = False
        Thread(target=self._receive, args=(FrameReader(connection, CellRequest),), daemon=True).start()

    def take(self, seconds: float) -> CellRequest | None:
        """Return the next request; if there is none, wait for one, or to be woken, for up to `seconds`."""
        with self._news:
            if not (self._waiting or self._woken or self.closed):
                self._news.wait(seconds)
            self._woken = False
            return self._waiting.popleft() if self._waiting else None

    def wake(self) -> None:
        """End the wait."""
        with self._news:
            self._woken = True
            self._news.notify()

    def _receive(self, reader: FrameReader[CellRequest]) -> None:
        try:
            while (request := reader.read()) is not None:
                self._put(request)
        except (OSError, InvalidFrame):
            pass
        self.closed = True
        self.wake()

    def _put(self, request: CellRequest) -> None:
        with self._news:
            if len(self._waiting) < MAX_WAITING:
                self._waiting.append(request)
                self._news.notify()
                return
        reason = f"{MAX_WAITING} requests wait for the cell; try again later"
        self._outbox.send(CellAnswer(number=request.number, refused=Refused(kind="busy", reason=reason)))


def listen_for_stops(connection: socket.socket, stop: Callable[[StopRequest], None]) -> None:
    """Call `stop` from a thread for each stop that arrives."""

    def receive(reader: FrameReader[StopRequest]) -> None:
        try:
            while (request := reader.read()) is not None:
                stop(request)
        except (OSError, InvalidFrame):
            return

    Thread(target=receive, args=(FrameReader(connection, StopRequest),), daemon=True).start()
