"""Limits how many planners run at once in a cell; the plannings beyond wait for one to end."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from skillc_runtime.execution.assignment import Assignment, NotStarted, PreparedTask
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.preparation import Preparation, StartPreparation
from skillc_runtime.planning.progress import PlanningProgress

MAX_PLANNERS = 2
"""How many planners run at once; each may take a processor and up to its limit of memory."""


class PlanningQueue:
    """Starts plannings, up to `limit` at once; whoever asks first for an answer then comes first."""

    def __init__(self, start: StartPreparation, limit: int = MAX_PLANNERS) -> None:
        self._start, self._limit = start, limit
        self._going_on = set[QueuedPlanning]()

    def __call__(self, assignment: Assignment, failures: FailedSteps) -> QueuedPlanning:
        """Start to plan, now or once fewer planners run."""
        return QueuedPlanning(self, partial(self._start, assignment, failures))

    def queue(self, start: StartPreparation) -> StartPreparation:
        """Return what starts to plan in another way once fewer planners run, which count together with all others."""
        return lambda assignment, failures: QueuedPlanning(self, partial(start, assignment, failures))

    @property
    def waits_for(self) -> str:
        """For what a planning waits that begins now; empty if for nothing."""
        return f"waits for one of {self._limit} planners" if len(self._going_on) >= self._limit else ""

    def begin(self, planning: QueuedPlanning, start: Callable[[], Preparation]) -> Preparation | None:
        """Start a planning; None while as many as possible go on."""
        if len(self._going_on) >= self._limit:
            return None
        job = start()
        self._going_on.add(planning)
        return job

    def end(self, planning: QueuedPlanning) -> None:
        """Let another planning begin."""
        self._going_on.discard(planning)


class QueuedPlanning:
    """A planning that begins when its queue allows it, at the next look for its answer."""

    def __init__(self, queue: PlanningQueue, start: Callable[[], Preparation]) -> None:
        self._queue, self._start = queue, start
        self._job: Preparation | None = None

    @property
    def waits_for(self) -> str:
        """For what it waits before it begins; empty once it goes on."""
        return self._queue.waits_for if self._job is None else ""

    @property
    def progress(self) -> PlanningProgress | None:
        """How far its planner is; None if that is not known."""
        return None if self._job is None else self._job.progress

    def poll(self) -> PreparedTask | NotStarted | None:
        """Return the answer, None if there is none yet; never waits."""
        return self._take(lambda job: job.poll())

    def wait(self, seconds: float) -> PreparedTask | NotStarted | None:
        """Wait for the answer for up to `seconds` of wall time; not for its turn."""
        return self._take(lambda job: job.wait(seconds))

    def kill(self) -> None:
        """End the planning within a few seconds."""
        if self._job is not None:
            self._job.kill()
        self._queue.end(self)

    def _take(
        self, look: Callable[[Preparation], PreparedTask | NotStarted | None]
    ) -> PreparedTask | NotStarted | None:
        """Begin if it is its turn, and look for the answer."""
        self._job = self._job or self._queue.begin(self, self._start)
        answer = look(self._job) if self._job is not None else None
        if answer is not None:
            self._queue.end(self)
        return answer
