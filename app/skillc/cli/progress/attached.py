"""Shows an operation of a server in the terminal, with the keys of a run; the operation goes on without it."""

from __future__ import annotations

import time
from concurrent.futures import CancelledError
from contextlib import suppress
from queue import Empty, SimpleQueue
from threading import Thread

from skillc.cli.console import find_display_obstacle
from skillc.cli.output.operation_remarks import remark_going_on, remark_status
from skillc.cli.progress.run_progress import RunProgress
from skillc.cli.progress.run_view import EventView
from skillc.client.cell import ServerCell
from skillc.client.operation import ServerOperation
from skillc.errors import ServiceError
from skillc_runtime.execution.pace import FAST, Pace
from skillc_runtime.recording.commands import Command
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import PromptsChanged, Requested, StateChanged, TaskEnded
from skillc_runtime.recording.states import ENDS

LOOK_S = 0.05
CLOCK_HZ = 4.0
"""How often the clock of a display goes on between events."""
PLANNING_S = 0.5
"""How often it is asked how far a planner is, in s."""


class EventQueue:
    """The events of an operation, which a thread receives; `error` is why there are no more before it has ended."""

    def __init__(self, operation: ServerOperation) -> None:
        self.ended, self.error = False, ""
        self._waiting = SimpleQueue[Envelope | None]()
        self._operation = operation
        Thread(target=self._receive, daemon=True).start()

    def take(self) -> list[Envelope]:
        """Return the events that have come since this was called last."""
        found = list[Envelope]()
        while not self.ended:
            try:
                event = self._waiting.get_nowait()
            except Empty:
                break
            if event is None:
                self.ended = True
            else:
                found.append(event)
        return found

    def _receive(self) -> None:
        try:
            for each in self._operation.events():
                self._waiting.put(each)  # wait ends: at once, the queue has no limit
        except ServiceError as error:
            self.error = str(error)
        except CancelledError:
            pass  # the connection is closed: nobody wants to know any more
        self._waiting.put(None)  # wait ends: at once, the queue has no limit


class CellTime:
    """The clock of a cell, `now_s`, which a thread reads from samples, so that it goes on between events."""

    def __init__(self, cell: ServerCell) -> None:
        self.now_s = 0.0
        self._cell = cell
        Thread(target=self._receive, daemon=True).start()

    def _receive(self) -> None:
        with suppress(ServiceError, CancelledError):  # the events say what is wrong
            for each in self._cell.samples(CLOCK_HZ):
                self.now_s = each.time_s


def attach(cell: ServerCell, operation: ServerOperation) -> int:
    """Show an operation until it has ended or its user detaches; return the exit code.

    ServiceError if the server is away for too long.
    """
    factor = cell.status.pace
    pace = Pace(FAST if factor is None else factor)
    if not cell.status.paceable:
        pace.fix()
    with RunProgress(operation.task, False, pace, detachable=True) as progress, progress.operating():
        feed = EventQueue(operation)
        watcher = _Watcher(cell, operation, progress, CellTime(cell))
        while not feed.ended and not progress.detached and not progress.interrupted:
            watcher.show(feed.take())
    if feed.error:
        raise ServiceError(feed.error)
    if feed.ended:
        status = operation.status
        if find_display_obstacle() is None:
            remark_status(status)
        return 0 if status.is_sound else 3
    remark_going_on(operation.id)
    return 0


class _Watcher:
    """Shows events as they come, and passes on what the keys mean."""

    def __init__(self, cell: ServerCell, operation: ServerOperation, progress: RunProgress, clock: CellTime) -> None:
        self._cell, self._operation, self._progress, self._clock = cell, operation, progress, clock
        self._view, self._now, self._pace = EventView(), 0.0, progress.pace.factor
        self._asked_at = 0.0

    def show(self, events: list[Envelope]) -> None:
        for each in events:
            self._now = each.cell_time_s
            self._view.observe(each.event)
            self._progress(each.event, max(0.0, (time.time_ns() - each.wall_time_ns) * 1e-9))
        changed = any(isinstance(each.event, StateChanged | PromptsChanged | Requested | TaskEnded) for each in events)
        plans = self._operation.last_status.state == "planning" and time.monotonic() - self._asked_at > PLANNING_S
        if changed or plans:
            self._refresh()
        status = self._operation.last_status
        if status.state in ENDS:
            time.sleep(LOOK_S)
            return
        self._now = max(self._now, self._clock.now_s)
        for command in self._progress.take_commands(lambda: self._view.view(status), self._now, LOOK_S):
            self._give(command)
        self._pass_pace_on()

    def _refresh(self) -> None:
        self._asked_at = time.monotonic()
        try:
            self._operation.status  # noqa: B018 - reading it asks the server
        except ServiceError as error:
            self._progress.remark(str(error))

    def _give(self, command: Command) -> None:
        known = command.name in self._operation.last_status.allowed
        try:
            self._operation.give(command)
        except ServiceError as error:
            if known:
                self._progress.remark(str(error))

    def _pass_pace_on(self) -> None:
        if (factor := self._progress.pace.factor) != self._pace:
            self._pace = factor
            try:
                self._cell.set_pace(factor)
            except ServiceError as error:
                self._progress.remark(str(error))
