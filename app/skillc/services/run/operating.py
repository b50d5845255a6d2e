"""Drives the loop of a cell with one task run, at the pace and by the commands of whoever monitors it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from typing import Protocol

from skillc_runtime.execution.cell_loop import CellLoop, TooManyRequests
from skillc_runtime.execution.execute import WAIT_S, drive
from skillc_runtime.execution.pace import Pace
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.recording.commands import Command
from skillc_runtime.recording.events import Event


class RunMonitor(Protocol):
    """Shows a run to its user, and passes on what the user wants; called with each event."""

    pace: Pace
    """The pace of the run, which may change at any time."""

    def __call__(self, event: Event) -> None:
        """Receive an event."""
        ...

    def say(self, message: str) -> None:
        """Receive a message about the preparation or the report."""
        ...

    def operating(self) -> AbstractContextManager[None]:
        """Return a context in which the user can give commands; KeyboardInterrupt in it ends the run at once."""
        ...

    def attend(self, run: TaskRun, now: float, seconds: float) -> Sequence[Command]:
        """Called before each tick, at the time `now` of the cell in s: return the commands that the user has given.

        If there are none, wait for them for `seconds` of wall time.
        """
        ...


def operate(loop: CellLoop, run: TaskRun, monitor: RunMonitor, heartbeat: Callable[[], None]) -> None:
    """Tick a loop until a run has ended; `heartbeat` is called again and again, also while no tick is due.

    A cell with a time of its own has no other pace.
    """

    pace = monitor.pace
    if loop.backend.capabilities.lock_step is None:
        pace.fix()

    def attend() -> bool:
        heartbeat()
        now = loop.backend.clock.now
        wait_s = _find_wait(run, now, pace, loop.waits_for_others)
        commands = monitor.attend(run, now, wait_s)
        for command in commands:
            _request(loop, run, command, monitor)
        return bool(commands) or wait_s < WAIT_S

    with monitor.operating():
        drive(loop, run, attend)


def _find_wait(run: TaskRun, now: float, pace: Pace, waits: bool) -> float:
    """Return how long to wait before the next tick, or before the next look: commands must not wait for a slow pace."""
    remaining_s = pace.remaining_s(now, standing=run.stands or waits)
    return 0.0 if run.state == "stopping" else min(remaining_s, WAIT_S)


def _request(loop: CellLoop, run: TaskRun, command: Command, monitor: RunMonitor) -> None:
    try:
        loop.request(run, command)
    except TooManyRequests as error:
        monitor.say(str(error))
