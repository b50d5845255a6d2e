"""Does jobs in processes that can be killed, some at a time: cells go on beside them."""

from __future__ import annotations

import asyncio
import shutil
import sqlite3
from collections.abc import Awaitable, Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from http import HTTPStatus
from pathlib import Path
from typing import Literal, TypeAlias, TypeVar

from msgspec import structs

from skillc.contract.diagnosis import NO_DIAGNOSIS
from skillc.contract.job import FILE_TYPES, ONGOING, Job, JobChanged, JobOutcome
from skillc.server.jobs.store import JobStore
from skillc.server.log import log
from skillc.server.problems import ApiRefusal
from skillc.workers.pool import TooMuchWork, WorkCrashed, Workers, WorkFailed, WorkTimedOut
from skillc.workers.questions import Work

LaneName: TypeAlias = Literal["plans", "simulations", "trials"]
T = TypeVar("T")
SIMULATION_S = 900.0
"""How long what is simulated once may take, in s of wall time."""


class RunningJob:
    """A job that is done now, for a snapshot of its cell; what it leaves it writes to its `folder`."""

    def __init__(self, jobs: Jobs, workers: Workers, job: Job, snapshot: bytes) -> None:
        self._jobs, self._workers, self._snapshot = jobs, workers, snapshot
        self.id, self.folder, self.parts = job.id, jobs.folder / job.id, jobs.store.parts(job.id)

    async def answer(self, work: Work, kind: type[T], seconds: float) -> T:
        """Return what comes of work in a process that is killed after a time; errors as of `Workers.answer`."""
        return await self._workers.answer(work, self._snapshot, kind, seconds)

    def add_part(self, part: bytes, message: str, passed: bool) -> None:
        """Note that a part was done, what came of it as JSON, and whether it is as it should be."""
        job = self._jobs.find(self.id)
        self._jobs.note(structs.replace(job, done=job.done + 1, failed=job.failed + (not passed)), message, part)


JobRun: TypeAlias = Callable[[RunningJob], Awaitable[JobOutcome | None]]
"""Does a job, and returns the outcome; None for one that is made of the parts."""


@dataclass(frozen=True, slots=True)
class Lane:
    """Where jobs that take about as long wait for each other: `count` are done at once, up to `limit` not yet."""

    workers: Workers
    limit: int
    turns: asyncio.Semaphore

    @classmethod
    def of(cls, workers: Workers, limit: int) -> Lane:
        """Return a lane in which as many jobs are done at once as there are workers."""
        return cls(workers, limit, asyncio.Semaphore(workers.count))


@dataclass(slots=True)
class Jobs:
    """The jobs of a server, whose files are in a folder; `publish` hears what changes."""

    store: JobStore
    folder: Path
    lanes: Mapping[LaneName, Lane]
    publish: Callable[[JobChanged], None]
    _tasks: dict[str, tuple[LaneName, asyncio.Task[None]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        known = {each.id for each in self.store.list() if each.files or self._goes_on_later(each.id)}
        for each in self.folder.glob("*"):
            if each.name not in known:
                shutil.rmtree(each, ignore_errors=True)

    def check_room(self, name: LaneName) -> None:
        """Raise ApiRefusal (429) if no more jobs are taken in a lane now."""
        lane = self.lanes[name]
        if sum(of == name for of, _ in self._tasks.values()) >= lane.limit:
            raise ApiRefusal(HTTPStatus.TOO_MANY_REQUESTS, f"{lane.limit} {name} wait or go on; try again later")

    def find(self, name: str) -> Job:
        """Return a job; ApiRefusal (404) if there is none of this id."""
        if (found := self.store.find(name)) is None:
            raise ApiRefusal(HTTPStatus.NOT_FOUND, f"there is no job `{name}`")
        return found

    def begin(self, job: Job, lane: LaneName, snapshot: bytes, run: JobRun) -> Job:
        """Do a job, once those before it in its lane are done; ApiRefusal (409) if that was begun already."""
        if job.id in self._tasks:
            raise ApiRefusal(HTTPStatus.CONFLICT, f"{job.id} goes on")
        done = len(self.store.parts(job.id))
        failed = job.failed if done else 0
        job = structs.replace(job, state="waiting", reason="", problem=None, files=(), done=done, failed=failed)
        self.note(job, "waiting")
        self._tasks[job.id] = lane, asyncio.create_task(self._carry_out(job, self.lanes[lane], snapshot, run))
        for each in self.store.list_old():
            self.remove(each)
        return job

    def cancel(self, name: str, why: str) -> None:
        """End a job that goes on; nothing happens to others."""
        if (found := self._tasks.pop(name, None)) is not None:
            found[1].cancel()
        job = self.find(name)
        if job.state in ONGOING:
            self.note(structs.replace(job, state="cancelled", reason=why), f"cancelled {why}")

    def remove(self, name: str) -> None:
        """End a job, and forget it with its files."""
        job = self.find(name)
        if (found := self._tasks.pop(name, None)) is not None:
            found[1].cancel()
        self.store.remove(name)
        self._clear(name)
        self.publish(JobChanged(job=job, removed=True))

    async def close(self) -> None:
        """End all jobs; those that went on are interrupted when the server starts again."""
        for _, task in tuple(self._tasks.values()):
            task.cancel()
            with suppress(asyncio.CancelledError):
                await task
        for lane in self.lanes.values():
            lane.workers.close()

    def note(self, job: Job, message: str, part: bytes | None = None, outcome: JobOutcome | None = None) -> None:
        """Write how far a job is, and tell all who listen."""
        self.store.put(job, message, part, outcome)
        self.publish(JobChanged(job=job))

    async def _carry_out(self, job: Job, lane: Lane, snapshot: bytes, run: JobRun) -> None:
        try:
            async with lane.turns:
                self.note(structs.replace(job, state="running"), "running")
                outcome = await run(RunningJob(self, lane.workers, job, snapshot))
            self._end(job.id, outcome)
        except (WorkFailed, WorkTimedOut, TooMuchWork) as error:
            self._fail(job.id, error)
        except sqlite3.Error as error:
            log("job", job=job.id, problem=f"it cannot be kept: {error}")
        except Exception as error:  # noqa: BLE001 - the boundary of a task: a job has an end
            log("job", job=job.id, problem=repr(error))
            self._fail(job.id, WorkCrashed(f"an error of skillc: {error!r}"))
        except asyncio.CancelledError:
            self._clear_unless_begun(job.id)
            raise
        finally:
            if self._tasks.get(job.id, (None, None))[1] is asyncio.current_task():
                del self._tasks[job.id]

    def _end(self, name: str, outcome: JobOutcome | None) -> None:
        folder, job = self.folder / name, self.find(name)
        left = sorted(each.name for each in folder.iterdir()) if folder.is_dir() else ()
        files = tuple(each for each in left if Path(each).suffix in FILE_TYPES)
        ended = structs.replace(job, state="ended", files=files, done=job.wanted)
        self.note(ended, "ended", outcome=outcome)

    def _fail(self, name: str, error: WorkFailed | WorkTimedOut | TooMuchWork) -> None:
        diagnosis = error.diagnosis if isinstance(error, WorkFailed) else NO_DIAGNOSIS
        problem = ApiRefusal(HTTPStatus.UNPROCESSABLE_ENTITY, str(error), diagnosis=diagnosis).problem
        failed = structs.replace(self.find(name), state="failed", reason=str(error), problem=problem)
        self.note(failed, f"failed: {error}")
        self._clear_unless_begun(name)

    def _clear_unless_begun(self, name: str) -> None:
        """Remove the files of a job that has not got to its end, unless it goes on with them when it is begun again."""
        if not self._goes_on_later(name):
            self._clear(name)

    def _goes_on_later(self, name: str) -> bool:
        return bool(self.store.parts(name))

    def _clear(self, name: str) -> None:
        shutil.rmtree(self.folder / name, ignore_errors=True)
