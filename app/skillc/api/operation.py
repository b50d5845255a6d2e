"""An operation: one execution of a task in a thread of its own, which everybody may watch and command."""

from __future__ import annotations

import asyncio
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from datetime import datetime
from types import TracebackType
from typing import Literal

from skillc.api.boundary import api_call, refusing_values
from skillc.api.event_stream import EventStream
from skillc.api.operation_state import LOOK_S, OperationState
from skillc.api.run import Run
from skillc.errors import RequestError, ServiceError
from skillc.values.arguments import read_pace, require_choice, require_text
from skillc_runtime.devices.prompts import Prompt
from skillc_runtime.recording import commands
from skillc_runtime.recording.commands import Command
from skillc_runtime.recording.contact import ContactState
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.history.account import CallOutput, MeasuredProperty
from skillc_runtime.recording.states import State
from skillc_runtime.world.state.labels.labelling import label_change
from skillc_runtime.world.state.open_transaction import OpenTransaction

Depth = Literal["into", "over", "out"]
STEPS: dict[str, Command] = {
    "into": commands.StepInto(),
    "over": commands.StepOver(),
    "out": commands.StepOut(),
}


class Operation:
    """One execution of a task, from its submission to its end.

    Its methods may be called from any thread. A command returns when it took effect; RequestError says why it is
    refused in the present state, and what is allowed. As a context manager it stops the task if the block ends before
    the task does. It can be awaited: the value is its `Run`.
    """

    def __init__(self, state: OperationState) -> None:
        self._shared = state

    @property
    def id(self) -> str:
        """Its id, which no other run has."""
        return self._shared.id

    @property
    def task(self) -> str:
        """The name of its task, or the text of its goal or call."""
        return self._shared.task

    @property
    def state(self) -> State:
        """Its state: queued, planning, planned, running, pausing, paused, stopping, or one in which it has ended."""
        return self._shared.state

    @property
    def reason(self) -> str:
        """Why it is in its state, as a sentence; empty if there is nothing to say."""
        return self._shared.reason

    @property
    def contact(self) -> ContactState:
        """What becomes of a tool that pressed when it was paused: `kept`, `lifting`, `taken-off` or `approaching`.

        `none` if no tool pressed, or while the run is not paused.
        """
        return self._shared.contact

    @property
    def allowed(self) -> tuple[str, ...]:
        """The names of the commands that its state allows."""
        return self._shared.allowed

    @property
    def time_s(self) -> float:
        """The time of the cell in s."""
        return self._shared.time_s

    @property
    def submitted_at(self) -> datetime:
        """When it was submitted."""
        return self._shared.submitted_at

    @property
    def started_at(self) -> datetime | None:
        """When its first attempt began; None before."""
        return self._shared.account.started_at

    @property
    def ended_at(self) -> datetime | None:
        """When it ended; None before."""
        return self._shared.account.ended_at

    @property
    def failure(self) -> Failure | None:
        """Why it did not succeed, or why the step failed after which somebody has to decide how it goes on."""
        return self._shared.account.failure

    @property
    def outputs(self) -> tuple[CallOutput, ...]:
        """What its outermost calls have returned so far, the last hundred."""
        return self._shared.account.outputs

    @property
    def measures(self) -> tuple[MeasuredProperty, ...]:
        """The properties that it has measured so far, the last hundred."""
        return self._shared.account.measures

    @property
    def ended(self) -> bool:
        """Whether it has ended, and its result is there."""
        return self._shared.over

    @property
    def pace(self) -> float:
        """How fast the time of the cell passes compared with the clock on the wall; infinite for no limit."""
        return self._shared.pace.factor

    @pace.setter
    def pace(self, pace: float | str) -> None:
        self._shared.pace.change(read_pace(pace))

    def events(self, after: int = 0) -> EventStream:
        """Return the events numbered from `after` + 1 on, as they happen; the stream ends with the operation.

        It can be iterated with `for`, which waits, and with `async for`, which does not block other coroutines.
        """
        return EventStream(self._shared.changed, self._shared.events, lambda: self._shared.over, after)

    def approve(self) -> None:
        """Run the plan that waits for approval."""
        self._command(commands.Approve())

    def pause(self, reason: str = "requested") -> None:
        """Pause, and wait until it is paused: at the next point where all active skills may be paused."""
        self._command(commands.PauseRun(require_text(reason, "the reason")))
        self._shared.wait_while("running", "pausing")

    def resume(self) -> None:
        """Continue after a pause."""
        self._command(commands.Resume())

    def step(self, depth: Depth = "into") -> State:
        """Continue until the next call of a skill starts, and return the state then: paused, unless it has ended.

        `over` skips the calls inside the present one, `out` those inside the call around it.
        """
        self._command(STEPS[require_choice(depth, Depth, "the step")])
        return self.wait_for_pause()

    def wait_for_pause(self) -> State:
        """Wait until it is paused, waits for approval, or has ended; return the state."""
        self._shared.wait_while("queued", "planning", "running", "pausing", "stopping")
        return self.state

    def stop(self, reason: str = "stopped") -> None:
        """Halt everything; the operation ends when everything is at rest. One that has ended stays as it is."""
        self._command(commands.Stop(require_text(reason, "the reason")))

    def retry(self) -> None:
        """After a failure: run the failed step again."""
        self._command(commands.RetryStep())

    def skip(self, who: str, why: str) -> None:
        """After a failure: count the failed step as done, because somebody did it; its effects are assumed."""
        self._command(commands.Skip(require_text(why, "`why`"), who=require_text(who, "`who`")))

    @property
    def prompts(self) -> tuple[Prompt, ...]:
        """What its skills ask operators: `text`, `choices`, and until when, in s of the cell's clock."""
        return self._shared.prompts

    def answer(self, choice: str, who: str, prompt: int = 0) -> None:
        """Answer what a skill asks; `prompt` is the `id` of one of `prompts`, 0 for the only one."""
        self._command(commands.AnswerPrompt(require_text(choice, "the choice"), prompt, who=require_text(who, "`who`")))

    def replan(self) -> None:
        """Halt what runs and plan again."""
        self._command(commands.Replan())

    @contextmanager
    def edit(self, who: str, why: str) -> Iterator[OpenTransaction]:
        """Collect writes to its world model in a `with` statement, and make them together at its end.

        `who` and `why` are recorded with them. RequestError if an axiom is violated or a name is unknown.
        """
        author, reason = require_text(who, "`who`"), require_text(why, "`why`")
        world = self._shared.world
        assert world is not None, "an operation that has started"
        state = world.snapshot()
        with api_call(), refusing_values():
            transaction = OpenTransaction(state)
            yield transaction
            changes = tuple(label_change(each, state.vocabulary) for each in transaction.changes)
            if changes:
                self._command(commands.EditWorld(changes, reason, who=author))

    def wait(self, timeout_s: float | None = None) -> Run:
        """Wait for the end and return the result. RequestError after `timeout_s` s of wall time; it goes on then.

        SkillcError if the task could not be carried out by a fault of the program or the machine. An interrupt from
        the keyboard stops the task safely, and is raised again when everything is at rest.
        """
        try:
            over = self._shared.wait_until_over(timeout_s)
        except KeyboardInterrupt:
            self._stop_and_wait("interrupted")
            raise
        if not over:
            raise RequestError(f"{self.task} has not ended within {timeout_s:g} s; it is {self.state}")
        return self._result()

    def __await__(self) -> Generator[object, None, Run]:
        return self._finished().__await__()

    def __enter__(self) -> Operation:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        if not self.ended:
            self._stop_and_wait("its `with` statement ended")

    async def _finished(self) -> Run:
        async for _ in self.events():
            pass
        while not self.ended:  # wait ends: the thread of the operation always sets a result or an error
            await asyncio.sleep(LOOK_S)
        return self._result()

    def _result(self) -> Run:
        shared = self._shared
        if shared.run is not None:
            return shared.run
        assert shared.error is not None, "an operation that is over"
        if isinstance(shared.error, Exception):
            with api_call():
                raise shared.error
        raise ServiceError(f"the thread of the operation was ended: {shared.error!r}") from shared.error

    def _stop_and_wait(self, reason: str) -> None:
        """Stop it, and wait until everything is at rest."""
        self._shared.ask_to_stop(reason)
        self._shared.wait_until_over(None)

    def _command(self, command: Command) -> None:
        """Give a command and wait until it took effect. RequestError if it is refused."""
        given = self._shared.give(command)
        self._shared.wait_for_answer(given)
        if given.refused:
            raise RequestError(given.refused)
        if not given.answered and not isinstance(command, commands.Stop):
            raise RequestError(f"`{command.name}` is refused: {self.task} has {self.state}")
