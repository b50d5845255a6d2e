"""What the thread of an operation and those who watch and command it share."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from datetime import UTC, datetime
from functools import partial
from math import inf

from skillc.api.run import Run
from skillc_runtime.devices.prompts import Prompt
from skillc_runtime.execution.pace import Pace
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.recording.commands import Command, Stop
from skillc_runtime.recording.contact import ContactState
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import Event, Requested
from skillc_runtime.recording.history.account import RunAccount
from skillc_runtime.recording.states import State
from skillc_runtime.world.state.model import WorldModel

LOOK_S = 0.1
"""How often a waiting thread looks again, so that it takes interrupts, in s of wall time."""


@dataclass(eq=False, slots=True)
class GivenCommand:
    """A command that was given, `answered` once it took effect or was `refused`."""

    command: Command
    answered: bool = False
    refused: str = ""


@dataclass(eq=False)
class OperationState:
    """The state of an operation; all is read and written under the condition `changed`, but for single fields.

    `world` is the world model, once it is loaded. `account` has its times, outputs and failure. `waiting` are the
    commands that its thread has not taken, `taken` those whose effect is not known, `settled` those whose effect is.
    """

    id: str
    task: str
    pace: Pace
    changed: threading.Condition = field(default_factory=threading.Condition)
    events: list[Envelope] = field(default_factory=list)
    waiting: deque[GivenCommand] = field(default_factory=deque)
    taken: list[GivenCommand] = field(default_factory=list)
    settled: list[GivenCommand] = field(default_factory=list)
    state: State = "queued"
    reason: str = ""
    contact: ContactState = "none"
    allowed: tuple[str, ...] = ("stop",)
    prompts: tuple[Prompt, ...] = ()
    time_s: float = 0.0
    world: WorldModel | None = None
    submitted_at: datetime = field(default_factory=partial(datetime.now, UTC))
    account: RunAccount = field(default_factory=RunAccount)
    run: Run | None = None
    error: BaseException | None = None

    @property
    def over(self) -> bool:
        """Whether there is a result, or an error instead."""
        return self.run is not None or self.error is not None

    def give(self, command: Command) -> GivenCommand:
        """Give a command; nobody takes it if all is over."""
        given = GivenCommand(command)
        with self.changed:
            if not self.over:
                self.waiting.append(given)
                self.changed.notify_all()
        return given

    def ask_to_stop(self, reason: str) -> None:
        """Give the command to stop, without waiting."""
        self.give(Stop(reason))

    def answer(self) -> None:
        """Answer the commands that took effect or were refused, once the state that they led to is known."""
        for each in self.settled:
            each.answered = True
        if self.settled:
            self.settled.clear()
            self.changed.notify_all()

    def wait_until_over(self, timeout_s: float | None) -> bool:
        """Wait for the end for up to `timeout_s` s of wall time; return whether it has ended."""
        left_s = inf if timeout_s is None else timeout_s
        with self.changed:
            while not self.over and left_s > 0.0:
                self.changed.wait(min(left_s, LOOK_S))
                left_s -= LOOK_S
        return self.over

    def wait_while(self, *states: State) -> None:
        """Wait until it is in another state, or over."""
        with self.changed:
            while self.state in states and not self.over:
                self.changed.wait(LOOK_S)

    def wait_for_answer(self, given: GivenCommand) -> None:
        """Wait until a command took effect or was refused, or all is over."""
        with self.changed:
            while not given.answered and not self.over:
                self.changed.wait(LOOK_S)

    def end(self, run: Run | None, error: BaseException | None) -> None:
        """Set the result, or why there is none."""
        with self.changed:
            status = "interrupted" if run is None else run.result.status
            self.state = "failed" if status == "refused" else status
            self.reason = (run.failure or "") if run is not None else str(error)
            self.run, self.error, self.allowed, self.contact = run, error, (), "none"
            self.answer()
            self.changed.notify_all()


class Monitor:
    """The monitor of a run in the thread of an operation: passes events on, and takes the commands that wait."""

    def __init__(self, state: OperationState) -> None:
        self.pace = state.pace
        self._state = state

    def __call__(self, event: Event) -> None:
        """Answer the command that an event is about."""
        if not isinstance(event, Requested):
            return
        state = self._state
        with state.changed:
            given = next((each for each in state.taken if each.command == event.command), None)
            if given is not None:
                state.taken.remove(given)
                given.refused = event.refused
                state.settled.append(given)

    def record(self, envelope: Envelope) -> None:
        """Keep a numbered event."""
        with self._state.changed:
            self._state.events.append(envelope)
            self._state.account(envelope)
            self._state.time_s = envelope.cell_time_s
            self._state.changed.notify_all()

    def say(self, message: str) -> None:
        """Do nothing: the state says what is prepared."""

    def operating(self) -> AbstractContextManager[None]:
        """Return a context that does nothing: signals stay with the program."""
        return nullcontext()

    def attend(self, run: TaskRun, now: float, seconds: float) -> Sequence[Command]:
        """Return the commands that wait; wait for them for `seconds` if there are none."""
        state = self._state
        with state.changed:
            if state.state != run.state:
                state.changed.notify_all()
            state.state, state.reason, state.allowed, state.time_s = run.state, run.reason, tuple(run.allowed), now
            state.prompts, state.contact = run.prompts, run.contact
            state.answer()
            if not state.waiting and seconds > 0.0:
                state.changed.wait(seconds)
            taken = list(state.waiting)
            state.waiting.clear()
            state.taken += taken
        return [each.command for each in taken]
