"""An operation of a server; made from `async_operation` by `python tests/accept.py`, not edited."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from skillc.client.async_operation import Depth
from skillc.client.waiting import WaitingOperation
from skillc.contract.commands import Command
from skillc.contract.job import TaskResult
from skillc.contract.operation import (
    Decision,
    OperationStatus,
    State,
)
from skillc.contract.runs.explanation import RunExplanation
from skillc.contract.runs.run_diff import RunDiff
from skillc.contract.runs.run_tree import OperationTree
from skillc.contract.runs.signals import SignalRows
from skillc.events import Envelope


class ServerOperation(WaitingOperation):
    """An operation of a server; its methods are those of `AsyncOperation`, and wait.

    Its properties ask the server each time, but for `id` and `task`.
    """

    def tree(self) -> OperationTree:
        """Show the tree of an operation, with the numbers that events have."""
        return self._loop.run(self._client.tree())

    def explain(self, question: str = "") -> RunExplanation:
        """Explain what an operation has chosen, how it ended, and why.

        What to explain besides: a step, a skill, an implementation or a parameter, as of `skillc why`.
        """
        return self._loop.run(self._client.explain(question))

    def signals(
        self, match: str = "", after_s: float = -1.0, until_s: float = 1000000000.0, every_s: float = 0.0
    ) -> SignalRows:
        """Read recorded signals of an operation, at most 5000 rows at once.

        Which signals: those whose columns contain one of the words in `match`, separated by commas; all without.

        Those after `after_s` until `until_s` of the cell's time, `every_s` apart at least.
        """
        return self._loop.run(self._client.signals(match, after_s, until_s, every_s))

    def compare(self, other: str) -> RunDiff:
        """Compare an operation with another one.

        The operation to compare with.
        """
        return self._loop.run(self._client.compare(other))

    def events(self, after: int = 0) -> Iterator[Envelope]:
        """Yield the events numbered from `after` + 1 on, as they happen, until it has ended.

        A connection that breaks is made again, also when the server is started again meanwhile: no event is missing,
        and none comes twice.
        """
        return self._loop.iterate(self._client.events(after))

    def recording(self, path: str | Path) -> Path:
        """Write its recording to a file, an MCAP file, and return the file; `skillc.open_run` reads it.

        While it goes on, that is what is written up to now. RefusedError if it has none.
        """
        return self._loop.run(self._client.recording(path))

    def report(self, folder: str | Path, film: bool = True) -> TaskResult:
        """Write its report with figures and film to a folder, once it has ended, and return the result in it.

        The server runs it again for that.
        Without `film` that takes a fraction of the time. RefusedError if it has not ended, or cannot be repeated.
        """
        return self._loop.run(self._client.report(folder, film))

    def approve(self) -> None:
        """Run the plan that waits for approval."""
        self._loop.run(self._client.approve())

    def pause(self, reason: str = "requested") -> None:
        """Pause, and wait until it is paused: at the next point where all active skills may be paused."""
        self._loop.run(self._client.pause(reason))

    def resume(self) -> None:
        """Continue after a pause."""
        self._loop.run(self._client.resume())

    def step(self, depth: Depth = "into") -> State:
        """Continue until the next call of a skill starts, and return the state then: paused, unless it has ended.

        `over` skips the calls inside the present one, `out` those inside the call around it.
        """
        return self._loop.run(self._client.step(depth))

    def wait_for_pause(self) -> State:
        """Wait until it is paused, waits for approval, or has ended; return the state."""
        return self._loop.run(self._client.wait_for_pause())

    def stop(self, reason: str = "stopped") -> None:
        """Halt everything; it ends when everything is at rest. One that has ended stays as it is."""
        self._loop.run(self._client.stop(reason))

    def retry(self) -> None:
        """After a failure: run the failed step again."""
        self._loop.run(self._client.retry())

    def skip(self, why: str) -> None:
        """After a failure: count the failed step as done, because somebody did it; its effects are assumed.

        Who says so is the owner of the token.
        """
        self._loop.run(self._client.skip(why))

    def answer(self, choice: str, prompt: int = 0) -> None:
        """Answer what a skill asks; `prompt` is the `id` of one of `prompts`, 0 for the only one."""
        self._loop.run(self._client.answer(choice, prompt))

    def set_breakpoints(self, *places: str) -> None:
        """Pause before each SKILL or FILE:LINE of `places` from now on, and before no others; without any, nowhere.

        `status.breakpoints` are those that it has.
        """
        self._loop.run(self._client.set_breakpoints(*places))

    def replan(self) -> None:
        """Halt what runs and plan again."""
        self._loop.run(self._client.replan())

    def continue_as(self, decision: Decision = "replan", why: str = "") -> ServerOperation:
        """Continue it after it was interrupted, and return the operation that does.

        `status.decisions` are those that there are; `why` is why a step that is skipped counts as done.
        """
        return ServerOperation(self._loop, self._loop.run(self._client.continue_as(decision, why)))

    def give(self, command: Command) -> None:
        """Give any command, without waiting for what it leads to."""
        self._loop.run(self._client.give(command))

    def wait(self, timeout_s: float | None = None) -> OperationStatus:
        """Wait for the end and return how it ended. RequestError after `timeout_s` s of wall time; it goes on then."""
        return self._loop.run(self._client.wait(timeout_s))
