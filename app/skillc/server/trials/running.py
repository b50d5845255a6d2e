"""Runs series of trials in a process that can be killed, one trial after the other: cells go on beside them."""

from __future__ import annotations

import asyncio
import sqlite3
from contextlib import closing, suppress
from dataclasses import dataclass, field

from skillc.contract.jobs import RunTrial
from skillc.contract.trials import TrialSeries, TrialsRequest
from skillc.server.log import log
from skillc.server.trials.store import TrialStore
from skillc.workers.pool import JobCrashed, JobFailed, JobTimedOut, TooManyJobs, Workers
from skillc_runtime.evaluation.trials.trial import Trial
from skillc_runtime.recording.envelope import make_run_id

MAX_UNFINISHED = 8
"""How many series may wait or go on."""
PREPARATION_S = 600.0
"""How long loading and planning may take, in s."""


@dataclass(slots=True)
class TrialRuns:
    """The series that wait or go on; one goes on at a time, in the order of their submission."""

    store: TrialStore
    _tasks: dict[str, asyncio.Task[None]] = field(default_factory=dict)
    _turn: asyncio.Lock = field(default_factory=asyncio.Lock)

    @property
    def full(self) -> bool:
        """Whether no more are taken now."""
        return len(self._tasks) >= MAX_UNFINISHED

    def begin(self, cell: str, scene: str, request: TrialsRequest, known: bytes) -> TrialSeries:
        """Add a series; `known` is an encoded snapshot of the cell, which has the library."""
        name = make_run_id(request.task)
        self.store.add(name, cell, request)
        added = self.store.find(name)
        assert added is not None, "it was added"
        self._tasks[name] = asyncio.create_task(self._run(added, scene, known))
        return added

    def remove(self, name: str) -> None:
        """End and forget a series."""
        if (task := self._tasks.pop(name, None)) is not None:
            task.cancel()
        self.store.remove(name)

    async def close(self) -> None:
        """End all series; they are interrupted when the server starts again."""
        for task in tuple(self._tasks.values()):
            task.cancel()
            with suppress(asyncio.CancelledError):
                await task

    async def _run(self, series: TrialSeries, scene: str, known: bytes) -> None:
        try:
            async with self._turn:  # each trial of those before it has its time limit
                self.store.set_state(series.id, "going on")
                with closing(Workers(count=1)) as workers:
                    reason = await self._run_trials(workers, series, scene, known)
            self.store.set_state(series.id, "ended", reason)
        except sqlite3.Error as error:
            log("trials", series=series.id, problem=f"they cannot be kept: {error}")
        finally:
            self._tasks.pop(series.id, None)

    async def _run_trials(self, workers: Workers, series: TrialSeries, scene: str, known: bytes) -> str:
        """Run all trials; return why some were not run, empty if all were."""
        request, prepared = series.request, False
        for seed in range(request.seed, request.seed + request.number):
            try:
                if not prepared:
                    await workers.answer(RunTrial(request, scene, None), known, type(None), PREPARATION_S)
                    prepared = True
            except (JobFailed, JobTimedOut, TooManyJobs) as error:
                return str(error)
            try:
                trial = await workers.answer(RunTrial(request, scene, seed), known, Trial, request.deadline_s)
            except JobCrashed as error:
                trial, prepared = Trial(seed=seed, status="crashed", reason=str(error)), False
            except JobTimedOut:
                why = f"it took longer than {request.deadline_s:g} s"
                trial, prepared = Trial(seed=seed, status="crashed", reason=why), False
            except (JobFailed, TooManyJobs) as error:
                return str(error)
            self.store.add_trial(series, trial)
        return ""
