"""An operation of a server, for programs with asyncio."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncGenerator, Generator
from contextlib import aclosing
from pathlib import Path
from typing import Any, Literal
from uuid import uuid4

from skillc.client.calls import OperationCalls
from skillc.client.errors import UnavailableError
from skillc.client.experiments import run_job
from skillc.client.feed import follow_operation
from skillc.client.retries import Retries
from skillc.contract import commands
from skillc.contract.api.endpoints import (
    GIVE_COMMAND,
    READ_JOB_FILE,
    READ_RECORDING,
    REMOVE_JOB,
    SHOW_OPERATION,
    STOP_OPERATION,
    SUBMIT_OPERATION,
)
from skillc.contract.commands import Command
from skillc.contract.job import ReportRequest, RunResult, TaskResult
from skillc.contract.operation import ENDS, ContactState, Decision, OperationRequest, OperationStatus, State, StopReason
from skillc.errors import RequestError
from skillc.events import Envelope, Prompt, StateChanged, TaskEnded

Depth = Literal["into", "over", "out"]
STEPS: dict[Depth, Command] = {
    "into": commands.StepInto(),
    "over": commands.StepOver(),
    "out": commands.StepOut(),
}
BEFORE_PAUSE: frozenset[State] = frozenset({"queued", "planning", "running", "pausing", "stopping"})


class AsyncOperation(OperationCalls):
    """An operation of a server. `status` is how it was when it was last heard of; `refresh` asks again.

    A command returns when it took effect. RefusedError if the server refuses it, UnavailableError if the server does
    not answer. It can be awaited: the value is the status with which it ended. Nothing here stops it but `stop`.
    """

    @property
    def task(self) -> str:
        """The name of its task, or the text of its goal or call."""
        request = self.status.request
        return request.task or request.goal or request.call or ""

    @property
    def state(self) -> State:
        """Its state when it was last heard of."""
        return self.status.state

    @property
    def reason(self) -> str:
        """Why it is in its state, or for what it waits; empty if there is nothing to say."""
        return self.status.reason

    @property
    def contact(self) -> ContactState:
        """What becomes of a tool that pressed when it was paused: `kept`, `lifting`, `taken-off` or `approaching`.

        `none` if no tool pressed, or while the run is not paused.
        """
        return self.status.contact

    @property
    def allowed(self) -> tuple[str, ...]:
        """The names of the commands that its state allows."""
        return self.status.allowed

    @property
    def ended(self) -> bool:
        """Whether it has ended."""
        return self.status.state in ENDS

    async def refresh(self) -> OperationStatus:
        """Ask the server how it is."""
        self.status = await self._connection.call(SHOW_OPERATION, self.id)
        return self.status

    def events(self, after: int = 0) -> AsyncGenerator[Envelope, None]:
        """Yield the events numbered from `after` + 1 on, as they happen, until it has ended.

        A connection that breaks is made again, also when the server is started again meanwhile: no event is missing,
        and none comes twice.
        """
        return follow_operation(self._connection, self.id, after)

    async def recording(self, path: str | Path) -> Path:
        """Write its recording to a file, an MCAP file, and return the file; `skillc.open_run` reads it.

        While it goes on, that is what is written up to now. RefusedError if it has none.
        """
        file = Path(path)
        await self._connection.download(READ_RECORDING, self.id, file=file)
        return file

    async def report(self, folder: str | Path, film: bool = True) -> TaskResult:
        """Write its report with figures and film to a folder, once it has ended, and return the result in it.

        The server runs it again for that.
        Without `film` that takes a fraction of the time. RefusedError if it has not ended, or cannot be repeated.
        """
        job, outcome = await run_job(self._connection, ReportRequest(operation=self.id, film=film), RunResult)
        place = Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        for each in job.files:
            await self._connection.download(READ_JOB_FILE, job.id, each, file=place / Path(each).name)
        await self._connection.call(REMOVE_JOB, job.id)
        return outcome.run

    async def approve(self) -> None:
        """Run the plan that waits for approval."""
        await self._command(commands.Approve())

    async def pause(self, reason: str = "requested") -> None:
        """Pause, and wait until it is paused: at the next point where all active skills may be paused."""
        await self._command(commands.PauseRun(reason))
        await self._wait_while(frozenset({"running", "pausing"}))

    async def resume(self) -> None:
        """Continue after a pause."""
        await self._command(commands.Resume())

    async def step(self, depth: Depth = "into") -> State:
        """Continue until the next call of a skill starts, and return the state then: paused, unless it has ended.

        `over` skips the calls inside the present one, `out` those inside the call around it.
        """
        await self._command(STEPS[depth])
        return await self.wait_for_pause()

    async def wait_for_pause(self) -> State:
        """Wait until it is paused, waits for approval, or has ended; return the state."""
        await self._wait_while(BEFORE_PAUSE)
        return self.state

    async def stop(self, reason: str = "stopped") -> None:
        """Halt everything; it ends when everything is at rest. One that has ended stays as it is."""
        self.status = await self._connection.call(STOP_OPERATION, self.id, body=StopReason(reason))

    async def retry(self) -> None:
        """After a failure: run the failed step again."""
        await self._command(commands.RetryStep())

    async def skip(self, why: str) -> None:
        """After a failure: count the failed step as done, because somebody did it; its effects are assumed.

        Who says so is the owner of the token.
        """
        await self._command(commands.Skip(why))

    @property
    def prompts(self) -> tuple[Prompt, ...]:
        """What its skills ask operators: `text`, `choices`, and until when, in s of the cell's clock."""
        return self.status.prompts

    async def answer(self, choice: str, prompt: int = 0) -> None:
        """Answer what a skill asks; `prompt` is the `id` of one of `prompts`, 0 for the only one."""
        await self._command(commands.AnswerPrompt(choice, prompt=prompt))

    async def set_breakpoints(self, *places: str) -> None:
        """Pause before each SKILL or FILE:LINE of `places` from now on, and before no others; without any, nowhere.

        `status.breakpoints` are those that it has.
        """
        await self._command(commands.SetBreakpoints(places))

    async def replan(self) -> None:
        """Halt what runs and plan again."""
        await self._command(commands.Replan())

    async def continue_as(self, decision: Decision = "replan", why: str = "") -> AsyncOperation:
        """Continue it after it was interrupted, and return the operation that does.

        `status.decisions` are those that there are; `why` is why a step that is skipped counts as done.
        """
        request = OperationRequest(continues=self.id, decision=decision, why=why)
        cell, key = self.status.cell, str(uuid4())
        status = await self._connection.call(SUBMIT_OPERATION, cell, body=request, key=key)
        return AsyncOperation(self._connection, status)

    async def give(self, command: Command) -> None:
        """Give any command, without waiting for what it leads to."""
        if isinstance(command, commands.Stop):
            await self.stop(command.reason)
        else:
            await self._command(command)

    async def wait(self, timeout_s: float | None = None) -> OperationStatus:
        """Wait for the end and return how it ended. RequestError after `timeout_s` s of wall time; it goes on then."""
        try:
            async with asyncio.timeout(timeout_s):
                await self._wait_while(None)
        except TimeoutError as error:
            raise RequestError(f"{self.task} has not ended within {timeout_s:g} s; it is {self.state}") from error
        return self.status

    def __await__(self) -> Generator[Any, None, OperationStatus]:
        return self.wait().__await__()  # wait ends: with the operation, or whoever awaits it cancels it

    async def _command(self, command: Command) -> None:
        self.status = await self._connection.call(GIVE_COMMAND, self.id, body=command)

    async def _wait_while(self, states: frozenset[State] | None) -> None:
        """Wait until it is in another state, or until it has ended if None."""
        status = await self._refresh_patiently()
        while status.state not in ENDS and (states is None or status.state in states):
            async with aclosing(follow_operation(self._connection, self.id, status.events)) as events:
                async for each in events:
                    if isinstance(each.event, StateChanged | TaskEnded):
                        break
            status = await self._refresh_patiently()

    async def _refresh_patiently(self) -> OperationStatus:
        """Ask how it is, again and again while the server is away."""
        retries = Retries()
        while True:
            try:
                return await self.refresh()
            except UnavailableError as error:
                await retries.wait(error)
