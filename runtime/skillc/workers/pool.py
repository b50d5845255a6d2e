"""Keeps a few processes for jobs; those beyond wait, and one that takes too long is killed."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TypeVar

import msgspec

from skillc.workers.answering import JobRefused, answer_job
from skillc.workers.jobs import Job
from skillc_runtime.execution.worker_process import Died, Raised, Returned, WorkerProcess

MAX_WORKERS, MAX_WAITING = 2, 20
"""How many jobs are done at once, and how many wait."""

T = TypeVar("T")


class JobFailed(Exception):
    """A job cannot be done; the message says why."""


class JobTimedOut(Exception):
    """A job took too long, and its process was killed."""


class TooManyJobs(Exception):
    """So many jobs wait that no more are taken."""


@dataclass(slots=True)
class Workers:
    """The processes of a server for jobs. They are started when they are first needed."""

    _idle: list[WorkerProcess] = field(default_factory=list)
    _free: asyncio.Semaphore = field(default_factory=lambda: asyncio.Semaphore(MAX_WORKERS))
    _waiting: int = 0

    async def answer(self, job: Job, snapshot: bytes, kind: type[T], seconds: float) -> T:
        """Return the answer to a job for an encoded snapshot; JobFailed, JobTimedOut or TooManyJobs otherwise."""
        with self._waits():
            async with self._free:
                return msgspec.json.decode(await asyncio.to_thread(self._ask, job, snapshot, seconds), type=kind)

    def close(self) -> None:
        """End the processes."""
        while self._idle:
            self._idle.pop().kill()

    @contextmanager
    def _waits(self) -> Iterator[None]:
        if self._waiting >= MAX_WORKERS + MAX_WAITING:
            raise TooManyJobs(f"{MAX_WAITING} requests wait for a process that answers them; try again later")
        self._waiting += 1
        try:
            yield
        finally:
            self._waiting -= 1

    def _ask(self, job: Job, snapshot: bytes, seconds: float) -> bytes:
        """Let a process do a job; it is kept for the next one if it has answered."""
        worker = self._idle.pop() if self._idle else WorkerProcess(answer_job, "spawn")
        try:
            worker.ask((job, snapshot))
            result = worker.wait(seconds)
        except BaseException:
            worker.kill()
            raise
        if isinstance(result, Returned):
            self._idle.append(worker)
        else:
            worker.kill()
        match result:
            case Returned(bytes() as answer):
                return answer
            case Returned(JobRefused(why)) | Raised(why):
                raise JobFailed(why)
            case Died(why):
                raise JobFailed(f"the process that should have answered has ended: {why}")
            case _:
                raise JobTimedOut(f"it took more than {seconds:g} s, and was ended; ask for less")
