"""An operation of a server."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from skillc.client.async_operation import AsyncOperation, Depth
from skillc.client.loop_thread import LoopThread
from skillc.contract.commands import Command
from skillc.contract.operation import Decision, OperationStatus, State
from skillc.contract.report import OperationReport
from skillc.events import Envelope, Prompt


class ServerOperation:
    """An operation of a server; its methods are those of `AsyncOperation`, and wait.

    Its properties ask the server each time, but for `id` and `task`.
    """

    def __init__(self, loop: LoopThread, operation: AsyncOperation) -> None:
        self._loop, self._operation = loop, operation

    @property
    def id(self) -> str:
        """Its id, which no other has."""
        return self._operation.id

    @property
    def task(self) -> str:
        """The name of its task, or the text of its goal or call."""
        return self._operation.task

    @property
    def status(self) -> OperationStatus:
        """How it is now."""
        return self._loop.run(self._operation.refresh())

    @property
    def last_status(self) -> OperationStatus:
        """How it was when it was last heard of, without asking the server."""
        return self._operation.status

    @property
    def state(self) -> State:
        """Its state: queued, planning, planned, running, pausing, paused, stopping, or one in which it has ended."""
        return self.status.state

    @property
    def reason(self) -> str:
        """Why it is in its state, or for what it waits; empty if there is nothing to say."""
        return self.status.reason

    @property
    def allowed(self) -> tuple[str, ...]:
        """The names of the commands that its state allows."""
        return self.status.allowed

    @property
    def ended(self) -> bool:
        """Whether it has ended."""
        self._loop.run(self._operation.refresh())
        return self._operation.ended

    def events(self, after: int = 0) -> Iterator[Envelope]:
        """Yield the events numbered from `after` + 1 on, as they happen, until it has ended: each of them once."""
        return self._loop.iterate(self._operation.events(after))

    def recording(self, path: str | Path) -> Path:
        """Write its recording to a file, an MCAP file, and return the file; `skillc.open_run` reads it."""
        return self._loop.run(self._operation.recording(path))

    def report(self, folder: str | Path, film: bool = True) -> OperationReport:
        """Write its report with figures and film to a folder, once it has ended; the server runs it again for that.

        Without `film` that takes a fraction of the time.
        """
        return self._loop.run(self._operation.report(folder, film))

    def approve(self) -> None:
        """Run the plan that waits for approval."""
        self._loop.run(self._operation.approve())

    def pause(self, reason: str = "requested") -> None:
        """Pause, and wait until it is paused: at the next point where all active skills may be paused."""
        self._loop.run(self._operation.pause(reason))

    def resume(self) -> None:
        """Continue after a pause."""
        self._loop.run(self._operation.resume())

    def step(self, depth: Depth = "into") -> State:
        """Continue until the next call of a skill starts, and return the state then."""
        return self._loop.run(self._operation.step(depth))

    def wait_for_pause(self) -> State:
        """Wait until it is paused, waits for approval, or has ended; return the state."""
        return self._loop.run(self._operation.wait_for_pause())

    def stop(self, reason: str = "stopped") -> None:
        """Halt everything; it ends when everything is at rest. One that has ended stays as it is."""
        self._loop.run(self._operation.stop(reason))

    def retry(self) -> None:
        """After a failure: run the failed step again."""
        self._loop.run(self._operation.retry())

    def skip(self, why: str) -> None:
        """After a failure: count the failed step as done, because somebody did it; its effects are assumed."""
        self._loop.run(self._operation.skip(why))

    @property
    def prompts(self) -> tuple[Prompt, ...]:
        """What its skills ask operators: `text`, `choices`, and until when, in s of the cell's clock."""
        return self.status.prompts

    def answer(self, choice: str, prompt: int = 0) -> None:
        """Answer what a skill asks; `prompt` is the `id` of one of `prompts`, 0 for the only one."""
        self._loop.run(self._operation.answer(choice, prompt))

    @property
    def breakpoints(self) -> tuple[str, ...]:
        """Before which calls it pauses, each SKILL or FILE:LINE."""
        return self.status.breakpoints

    def set_breakpoints(self, *places: str) -> None:
        """Pause before each SKILL or FILE:LINE of `places` from now on, and before no others; without any, nowhere."""
        self._loop.run(self._operation.set_breakpoints(*places))

    def replan(self) -> None:
        """Halt what runs and plan again."""
        self._loop.run(self._operation.replan())

    def continue_as(self, decision: Decision = "replan", why: str = "") -> ServerOperation:
        """Continue it after it was interrupted, and return the operation that does.

        `status.decisions` are those that there are; `why` is why a step that is skipped counts as done.
        """
        return ServerOperation(self._loop, self._loop.run(self._operation.continue_as(decision, why)))

    def give(self, command: Command) -> None:
        """Give any command, without waiting for what it leads to."""
        self._loop.run(self._operation.give(command))

    def wait(self, timeout_s: float | None = None) -> OperationStatus:
        """Wait for the end and return how it ended. RequestError after `timeout_s` s of wall time; it goes on then."""
        return self._loop.run(self._operation.wait(timeout_s))
