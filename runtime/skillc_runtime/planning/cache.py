"""Planners that remember: the same problem, given to the same program, is not solved twice.

An answer is found by all that it depends on: the problem as text, the names of its things, the program, its version and
limits. One that was found in the last moment is good enough only for those who have no more time.
"""

from __future__ import annotations

import hashlib
import time
from collections.abc import Iterator
from typing import Protocol, TypeVar

import msgspec

from skillc_model.pddl.formulas import FALSE
from skillc_model.pddl.problem import Problem
from skillc_model.pddl.text import domain_text, problem_text, temporal_problem_text, temporal_text
from skillc_runtime.planning.plan import GaveUp, Planner, PlanResult, Solved
from skillc_runtime.planning.schedule import Schedule, Scheduler

FORMAT = 2
"""Counts up when the meaning of what is kept changes."""

SLACK = 0.95
"""An answer that took more of its time may have been cut short; so little more time is no reason to look again."""


Kept = TypeVar("Kept", "CachedPlan", "CachedSchedule")


class PlanCache(Protocol):
    """A place where answers are kept, whole or not at all."""

    def get(self, key: str) -> bytes | None:
        """Return what was kept under a key, None where there is nothing or where it is damaged."""
        ...

    def put(self, key: str, content: bytes) -> None:
        """Keep something; never raises where it cannot."""
        ...


class CachedPlan(msgspec.Struct, frozen=True):
    """A plan, the time there was to find it, in seconds, and whether that was more than needed."""

    solved: Solved
    deadline_s: float
    unhurried: bool


class CachedSchedule(msgspec.Struct, frozen=True):
    """A schedule, the time there was to find it, in seconds, and whether that was more than needed."""

    schedule: Schedule
    deadline_s: float
    unhurried: bool


class CachingPlanner:
    """A planner whose plans are kept; `who` tells programs, versions and limits apart."""

    def __init__(self, planner: Planner, shelf: PlanCache, who: str) -> None:
        self._planner, self._shelf, self._who = planner, shelf, who

    @property
    def name(self) -> str:
        """What users know the planner by."""
        return self._planner.name

    def plan(self, problem: Problem, deadline_s: float) -> PlanResult:
        """Return what was found before, or solve the problem."""
        if problem.goal == FALSE:
            return self._planner.plan(problem, deadline_s)
        key = _key(self._who, domain_text(problem.domain), problem_text(problem), *_names(problem))
        kept = _read(self._shelf.get(key), CachedPlan)
        if kept is not None and _is_enough(kept, deadline_s):
            return kept.solved
        begin = time.monotonic()
        answer = self._planner.plan(problem, deadline_s)
        if isinstance(answer, Solved):
            self._shelf.put(key, msgspec.json.encode(CachedPlan(answer, deadline_s, _unhurried(begin, deadline_s))))
        return answer


class CachingScheduler:
    """A scheduler whose schedules are kept; `who` tells programs, versions and limits apart."""

    def __init__(self, scheduler: Scheduler, shelf: PlanCache, who: str) -> None:
        self._scheduler, self._shelf, self._who = scheduler, shelf, who

    @property
    def name(self) -> str:
        """What users know the scheduler by."""
        return self._scheduler.name

    def schedule(self, problem: Problem, deadline_s: float) -> Schedule | GaveUp:
        """Return what was found before, or solve the problem."""
        if problem.goal == FALSE:
            return self._scheduler.schedule(problem, deadline_s)
        key = _key(self._who, temporal_text(problem.domain), temporal_problem_text(problem), *_names(problem))
        kept = _read(self._shelf.get(key), CachedSchedule)
        if kept is not None and _is_enough(kept, deadline_s):
            return kept.schedule
        begin = time.monotonic()
        answer = self._scheduler.schedule(problem, deadline_s)
        if isinstance(answer, Schedule):
            self._shelf.put(key, msgspec.json.encode(CachedSchedule(answer, deadline_s, _unhurried(begin, deadline_s))))
        return answer


def _is_enough(kept: CachedPlan | CachedSchedule, deadline_s: float) -> bool:
    return kept.unhurried or SLACK * deadline_s <= kept.deadline_s


def _unhurried(begin: float, deadline_s: float) -> bool:
    """Whether the program stopped by itself, and would have with more time."""
    return time.monotonic() - begin < SLACK * deadline_s


def _key(*parts: str) -> str:
    digest = hashlib.sha256(str(FORMAT).encode())
    for part in parts:
        digest.update(f"\n{len(part)}\n{part}".encode())
    return digest.hexdigest()


def _names(problem: Problem) -> Iterator[str]:
    """Yield what the names of the problem stand for, and what its actions bind: plans are kept in these words."""
    for name, iri in sorted(problem.names.items()):
        yield f"{name} {iri}"
    for action in problem.domain.actions:
        yield " ".join((action.name, action.skill or "", *action.binds))
    if problem.rounds_down:
        yield from (f"{action.name} {action.cost}" for action in problem.domain.actions)
        yield from (f"{each.function} {each.arguments} {each.seconds}" for each in problem.costs)


def _read(content: bytes | None, kind: type[Kept]) -> Kept | None:
    if content is None:
        return None
    try:
        return msgspec.json.decode(content, type=kind)
    except msgspec.DecodeError:
        return None
