"""Keeps a few processes for jobs; those beyond wait, and one that takes too long is killed."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias, TypeVar

import msgspec

from skillc.contract.diagnosis import NO_DIAGNOSIS, Diagnosis
from skillc.contract.jobs import Job, JobRefused
from skillc.contract.runs.run_jobs import RunJob
from skillc.workers.programs import Program, do_job
from skillc_runtime.cancellation import Cancelled, CancelToken
from skillc_runtime.execution.worker_process import Died, Raised, Returned, WorkerProcess, WorkerResult

if TYPE_CHECKING:
    from skillc.cells.snapshot import CellSnapshot

MAX_WORKERS, MAX_WAITING = 2, 20
"""How many jobs are done at once, and how many wait."""
TURN_S = 30.0
"""How long a job may wait for a process, in s."""
START_S = 60.0
"""How long a process may take to start, in s."""

T = TypeVar("T")
Work: TypeAlias = "Callable[[CellSnapshot], object]"
"""A function that can be pickled, which does something with what a cell knows: its value is the answer."""
Request: TypeAlias = "tuple[Job | RunJob | Work, bytes]"


class JobFailed(Exception):
    """A job cannot be done; the message says why, and `diagnosis` which errors the request has."""

    def __init__(self, why: str, diagnosis: Diagnosis = NO_DIAGNOSIS) -> None:
        super().__init__(why or diagnosis.describe())
        self.diagnosis = diagnosis


class JobCrashed(JobFailed):
    """The process that did a job has died, or its code has raised what nobody expected."""


class JobTimedOut(Exception):
    """A job took too long, and its process was killed."""


class TooManyJobs(Exception):
    """So many jobs wait, or so many processes run, that no more are taken."""


@dataclass(slots=True)
class Workers:
    """The processes of a server for jobs, `count` at most. They are started when they are first needed.

    They do jobs by `program`. A job waits for a process for up to `turn_s`.
    """

    program: Program = do_job
    count: int = MAX_WORKERS
    turn_s: float = TURN_S
    _idle: list[WorkerProcess] = field(default_factory=list)
    _free: asyncio.Semaphore = field(init=False)
    _waiting: int = 0
    _ongoing: set[CancelToken] = field(default_factory=set)
    _warming: asyncio.Task[None] | None = None

    def __post_init__(self) -> None:
        self._free = asyncio.Semaphore(self.count)

    async def answer(self, job: Job | RunJob | Work, snapshot: bytes, kind: type[T], seconds: float) -> T:
        """Return the answer to a job for an encoded snapshot; JobFailed, JobTimedOut or TooManyJobs otherwise.

        If this is cancelled, the process is killed.
        """
        return msgspec.json.decode(await self._do((job, snapshot), seconds), type=kind)

    def warm(self) -> None:
        """Let a process start in the background, unless there is one, so that the first job need not wait for it."""
        if not self._idle and self._warming is None:
            self._warming = asyncio.create_task(self._start_one())

    async def _start_one(self) -> None:
        with suppress(JobFailed, JobTimedOut, TooManyJobs):  # the first job says so
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
                raise TooManyJobs(f"no process can be started ({error.strerror or error}); try again later") from error
            except Cancelled as error:
                raise JobTimedOut(f"it took more than {seconds:g} s, and was ended; ask for less") from error
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
        """Wait until a process is free, in a `with` statement; TooManyJobs if that takes too long."""
        if self._free.locked() and self._waiting >= MAX_WAITING:
            raise TooManyJobs(f"{MAX_WAITING} requests wait for a process that answers them; try again later")
        self._waiting += 1
        try:
            async with asyncio.timeout(self.turn_s):
                await self._free.acquire()  # wait ends: with the timeout
        except TimeoutError as error:
            raise TooManyJobs(f"no process was free for {self.turn_s:g} s; try again later") from error
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
        worker = WorkerProcess(self.program, "spawn") if new else self._idle.pop()
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
            case Returned(JobRefused(why, diagnosis)):
                raise JobFailed(why, diagnosis)
            case Raised(why):
                raise JobCrashed(why)
            case Died(why):
                raise JobCrashed(f"the process that should have answered has ended: {why}")
            case _:
                raise Cancelled(limit.reason or "")
