"""Planners with a cache: the same problem, given to the same program, is not solved twice.

The key of an answer covers everything that it depends on: the problem, the program, its version and its limits. An
answer that used up its time limit is reused only by callers who have no more time.
"""

from __future__ import annotations

import hashlib
from dataclasses import replace
from typing import Protocol, TypeVar

import msgspec
from msgspec import structs

from skillc_model.pddl.formulas import FALSE
from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.plan import GaveUp, Planner, PlanResult, Solved
from skillc_runtime.planning.progress import ReportProgress, ignore_progress
from skillc_runtime.planning.schedule import FoundSchedule, Schedule, Scheduler

FORMAT = 5
"""Raised with every change of what cached answers mean."""

FULL_SHARE = 0.95
"""A planner that used more than this share of its time limit may have been stopped by it."""

Entry = TypeVar("Entry", "CachedPlan", "CachedSchedule")


class PlanCache(Protocol):
    """A persistent store of answers; an entry is stored completely or not at all."""

    def get(self, key: str) -> bytes | None:
        """Return the content that is stored under a key, or None if it is missing or damaged."""
        ...

    def put(self, key: str, content: bytes) -> None:
        """Store content under a key; a failure to store it is ignored."""
        ...


class CachedPlan(msgspec.Struct, frozen=True):
    """A plan, the time limit for finding it in s, and whether the planner ended before that limit."""

    solved: Solved
    deadline_s: float
    ended_early: bool


class CachedSchedule(msgspec.Struct, frozen=True):
    """A schedule, the time limit for finding it in s, and whether the scheduler ended before that limit."""

    found: FoundSchedule
    deadline_s: float
    ended_early: bool


class CachingPlanner:
    """A planner whose plans are cached; `program` identifies the program, its version and its limits."""

    def __init__(self, planner: Planner, cache: PlanCache, program: str) -> None:
        self._planner, self._cache, self._program = planner, cache, program

    @property
    def name(self) -> str:
        """The name that is shown to users."""
        return self._planner.name

    def plan(self, problem: Problem, cancel: CancelToken, report: ReportProgress = ignore_progress) -> PlanResult:
        """Return the cached plan, or solve the problem and store the plan."""
        if problem.goal == FALSE:
            return self._planner.plan(problem, cancel, report)
        key = _key(self._program, problem)
        deadline_s = round(cancel.remaining_s, 2)
        cached = _decode(self._cache.get(key), CachedPlan)
        if cached is not None and _is_reusable(cached, deadline_s):
            return cached.solved
        answer = self._planner.plan(problem, cancel, report)
        if isinstance(answer, Solved) and cancel.cancelled_because is None:
            entry = CachedPlan(answer, deadline_s, _ended_early(cancel, deadline_s))
            self._cache.put(key, msgspec.json.encode(entry))
        return answer


class CachingScheduler:
    """A scheduler whose schedules are cached; `program` identifies the program, its version and its limits."""

    def __init__(self, scheduler: Scheduler, cache: PlanCache, program: str) -> None:
        self._scheduler, self._cache, self._program = scheduler, cache, program

    @property
    def name(self) -> str:
        """The name that is shown to users."""
        return self._scheduler.name

    def schedule(
        self,
        problem: Problem,
        first: Schedule | None,
        cancel: CancelToken,
        report: ReportProgress = ignore_progress,
    ) -> FoundSchedule | GaveUp:
        """Return the cached schedule, or solve the problem and store the schedule."""
        if problem.goal == FALSE:
            return self._scheduler.schedule(problem, first, cancel, report)
        key = _key(f"{self._program}, {first!r}", problem)
        deadline_s = round(cancel.remaining_s, 2)
        cached = _decode(self._cache.get(key), CachedSchedule)
        if cached is not None and _is_reusable(cached, deadline_s):
            return cached.found
        answer = self._scheduler.schedule(problem, first, cancel, report)
        if isinstance(answer, FoundSchedule) and cancel.cancelled_because is None:
            entry = CachedSchedule(answer, deadline_s, _ended_early(cancel, deadline_s))
            self._cache.put(key, msgspec.json.encode(entry))
        return answer


def _is_reusable(cached: CachedPlan | CachedSchedule, deadline_s: float) -> bool:
    return cached.ended_early or FULL_SHARE * deadline_s <= cached.deadline_s


def _ended_early(cancel: CancelToken, deadline_s: float) -> bool:
    """Whether the program ended before its time limit, so that more time would not have changed its answer."""
    return cancel.remaining_s > (1.0 - FULL_SHARE) * deadline_s


def _key(program: str, problem: Problem) -> str:
    """Return the key of a problem for a program: all values of the problem count, and the same ones give the same key.

    The text of the problem in PDDL would do as well, but what writes it takes long to import.
    """
    combined = sorted(map(sorted, problem.domain.combined))
    ordered = structs.replace(problem, domain=replace(problem.domain, combined=frozenset()))
    return hashlib.sha256("\n".join((str(FORMAT), program, repr(combined), repr(ordered))).encode()).hexdigest()


def _decode(content: bytes | None, kind: type[Entry]) -> Entry | None:
    if content is None:
        return None
    try:
        return msgspec.json.decode(content, type=kind)
    except msgspec.DecodeError:
        return None
