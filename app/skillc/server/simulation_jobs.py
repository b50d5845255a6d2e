"""Jobs of a server that simulate, one at a time, in a process that can be killed; each may leave files in a folder."""

from __future__ import annotations

import asyncio
import shutil
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from skillc.contract.jobs import Job
from skillc.workers.pool import JobFailed, JobTimedOut, TooManyJobs, Workers
from skillc_runtime.evaluation.report.result import TaskResult

LIMIT_S = 900.0
"""How long a job may take, in s of wall time."""
MAX_WAITING, MAX_ENDED = 8, 20
"""How many jobs may wait or go on, and of how many that have ended the results are kept."""


@dataclass(frozen=True, slots=True)
class JobOutcome:
    """How far a job is. Once it has `ended`, there is a `result`, or a `reason` why not; `files` are their names."""

    ended: bool = False
    reason: str = ""
    result: TaskResult | None = None
    files: tuple[str, ...] = ()


@dataclass(slots=True)
class SimulationJobs:
    """The jobs whose files are in a folder, which is emptied: they end with the server."""

    folder: Path
    _workers: Workers = field(default_factory=lambda: Workers(count=1, turn_s=MAX_WAITING * LIMIT_S))
    _outcomes: dict[str, JobOutcome] = field(default_factory=dict)
    _tasks: dict[str, asyncio.Task[None]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        shutil.rmtree(self.folder, ignore_errors=True)

    @property
    def full(self) -> bool:
        """Whether no more are taken now."""
        return len(self._tasks) >= MAX_WAITING

    def begin(self, name: str, make_job: Callable[[Path], Job], snapshot: bytes) -> None:
        """Do a job for an encoded snapshot of a cell, once those before it have ended; `make_job` is given its folder.

        What was done before under this name is forgotten, and so are the oldest ones.
        """
        self.remove(name)
        self._outcomes[name] = JobOutcome()
        self._tasks[name] = asyncio.create_task(self._carry_out(name, make_job(self.folder / name), snapshot))
        ended = [each for each in self._outcomes if each not in self._tasks]
        for each in ended[:-MAX_ENDED]:
            self.remove(each)

    def find(self, name: str) -> JobOutcome | None:
        """Return how far a job is; None if there is none of this name, or it is forgotten."""
        return self._outcomes.get(name)

    def find_file(self, name: str, file: str) -> Path | None:
        """Return a file that a job has left; None if there is none of this name."""
        found = self._outcomes.get(name)
        return self.folder / name / file if found is not None and file in found.files else None

    def remove(self, name: str) -> None:
        """End and forget a job."""
        self._outcomes.pop(name, None)
        if (task := self._tasks.pop(name, None)) is not None:
            task.cancel()
        else:
            self._clear(name)

    def close(self) -> None:
        """End all jobs."""
        for each in tuple(self._outcomes):
            self.remove(each)
        self._workers.close()
        with suppress(OSError):
            self.folder.rmdir()

    async def _carry_out(self, name: str, job: Job, snapshot: bytes) -> None:
        result, reason = None, ""
        try:
            result = await self._workers.answer(job, snapshot, TaskResult, LIMIT_S)
        except (JobFailed, JobTimedOut, TooManyJobs) as error:
            reason = str(error)
        except asyncio.CancelledError:
            self._clear(name)
            raise
        folder = self.folder / name
        files = tuple(sorted(each.name for each in folder.iterdir())) if folder.is_dir() else ()
        self._outcomes[name] = JobOutcome(True, reason, result, files)
        del self._tasks[name]

    def _clear(self, name: str) -> None:
        shutil.rmtree(self.folder / name, ignore_errors=True)
