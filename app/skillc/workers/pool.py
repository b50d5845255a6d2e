"""Keeps a few processes for work; what is beyond waits, and a process that takes too long is killed."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress
from dataclasses import dataclass, field
from typing import TypeAlias, TypeVar

import msgspec

from skillc.contract.diagnosis import NO_DIAGNOSIS, Diagnosis, WorkRefused
from skillc.workers.questions import Work
from skillc_runtime.cancellation import Cancelled, CancelToken
from skillc_runtime.execution.worker_process import Died, Raised, Returned, WorkerProcess, WorkerResult
from skillc_runtime.platforms.memory import limit_memory

MAX_WORKERS, MAX_WAITING = 2, 20
"""How much work is done at once, and how much waits."""
TURN_S = 30.0
"""How long work may wait for a process, in s."""
START_S = 60.0
"""How long a process may take to start, in s."""

MEMORY_BYTES = 4 * 2**30
"""The largest address space of a worker."""

T = TypeVar("T")
Request: TypeAlias = tuple[Work, bytes]


class WorkFailed(Exception):
    """Work cannot be done; the message says why, and `diagnosis` which errors the request has."""

    def __init__(self, why: str, diagnosis: Diagnosis = NO_DIAGNOSIS) -> None:
        super().__init__(why or diagnosis.describe())
        self.diagnosis = diagnosis


class WorkCrashed(WorkFailed):
    """The process that did the work has died, or its code has raised what nobody expected."""


class WorkTimedOut(Exception):
    """Work took too long, and its process was killed."""


class TooMuchWork(Exception):
    """So much work waits, or so many processes run, that no more is taken."""


@dataclass(slots=True)
class Workers:
    """The processes of a server for work, `count` at most. They are started when they are first needed.

    Work waits for a process for up to `turn_s`.
    """

    count: int = MAX_WORKERS
    turn_s: float = TURN_S
    _idle: list[WorkerProcess] = field(default_factory=list)
    _free: asyncio.Semaphore = field(init=False)
    _waiting: int = 0
    _ongoing: set[CancelToken] = field(default_factory=set)
    _warming: asyncio.Task[None] | None = None

    def __post_init__(self) -> None:
        self._free = asyncio.Semaphore(self.count)

    async def answer(self, work: Work, snapshot: bytes, kind: type[T], seconds: float) -> T:
        """Return what comes of work for an encoded snapshot; WorkFailed, WorkTimedOut or TooMuchWork otherwise.

        If this is cancelled, the process is killed.
        """
        return msgspec.json.decode(await self._do((work, snapshot), seconds), type=kind)

    def warm(self) -> None:
        """Let a process start in the background, unless there is one, so that the first work need not wait for it."""
        if not self._idle and self._warming is None:
            self._warming = asyncio.create_task(self._start_one())

    async def _start_one(self) -> None:
        with suppress(WorkFailed, WorkTimedOut, TooMuchWork):  # the first job says so
            await self._do(None, START_S)
        self._warming = None

    async def _do(self, request: Request | None, seconds: float) -> bytes:
        """Let a process answer a request; None only asks if it is ready."""
        async with self._turn():
            cancel = CancelToken()
            self._ongoing.add(cancel)
            try:
                return await asyncio.to_thread(self._ask, request, cancel, seconds)
            except OSError as error:
                raise TooMuchWork(f"no process can be started ({error.strerror or error}); try again later") from error
            except Cancelled as error:
                raise WorkTimedOut(f"it took more than {seconds:g} s, and was ended; ask for less") from error
            finally:
                cancel.cancel("nobody waits for the answer")
                self._ongoing.discard(cancel)

    def close(self) -> None:
        """End the processes."""
        for each in self._ongoing:
            each.cancel("the server ends")
        while self._idle:
            self._idle.pop().kill()

    @asynccontextmanager
    async def _turn(self) -> AsyncIterator[None]:
        """Wait until a process is free, in a `with` statement; TooMuchWork if that takes too long."""
        if self._free.locked() and self._waiting >= MAX_WAITING:
            raise TooMuchWork(f"{MAX_WAITING} requests wait for a process that answers them; try again later")
        self._waiting += 1
        try:
            async with asyncio.timeout(self.turn_s):
                await self._free.acquire()  # wait ends: with the timeout
        except TimeoutError as error:
            raise TooMuchWork(f"no process was free for {self.turn_s:g} s; try again later") from error
        finally:
            self._waiting -= 1
        try:
            yield
        finally:
            self._free.release()

    def _ask(self, request: Request | None, cancel: CancelToken, seconds: float) -> bytes:
        """Let a process answer a request; it is kept if it has answered. Cancelled if it is not to go on.

        The time in which a process starts does not count.
        """
        new = not self._idle
        worker = WorkerProcess(do_work, "spawn") if new else self._idle.pop()
        result: WorkerResult | None = None
        try:
            ready = not new or isinstance(worker.answer(None, cancel.limited(START_S)), Returned)
            limit = cancel.limited(seconds if ready else 0.0)
            result = worker.answer(request, limit) if ready else None
        finally:
            if isinstance(result, Returned):
                self._idle.append(worker)
            else:
                worker.kill()
        match result:
            case Returned(bytes() as answer):
                return answer
            case Returned(WorkRefused(why, diagnosis)):
                raise WorkFailed(why, diagnosis)
            case Raised(why):
                raise WorkCrashed(why)
            case Died(why):
                raise WorkCrashed(f"the process that should have answered has ended: {why}")
            case _:
                raise Cancelled(limit.reason or "")


def do_work(request: Request | None) -> bytes | WorkRefused:
    """Do work in this process, whose memory is limited from now on; it alone imports what that needs."""
    from skillc.workers.answering import answer_work

    limit_memory(MEMORY_BYTES)
    return answer_work(request)
