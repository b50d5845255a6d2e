"""Finds schedules with CP-SAT, and a lower bound of the makespan of every plan."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from contextlib import ExitStack
from importlib.util import find_spec
from itertools import count
from math import inf
from pathlib import Path

import msgspec
from msgspec.structs import replace

from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import Cancelled, CancelToken
from skillc_runtime.planning.cp_sat.activities import Activities, NotSchedulable, list_activities
from skillc_runtime.planning.cp_sat.task import ANSWER, TASK, ScheduleAnswer, ScheduleTask
from skillc_runtime.planning.plan import GaveUp
from skillc_runtime.planning.process import (
    Limits,
    ProcessEnded,
    ProcessNotStarted,
    RunningProcess,
    machine_limits,
    make_workplace,
    quote_line,
    wait_for_end,
)
from skillc_runtime.planning.progress import PlanningProgress, ReportProgress, ignore_progress
from skillc_runtime.planning.schedule import FoundSchedule, Schedule

GRACE_S = 1.0
"""How long before the time is up the program is told to end, so that it can write down what it knows."""
MAX_S = 86_400.0
"""The longest time that it is given."""
LISTING_SHARE = 0.5
"""The share of the time for listing what may be done; a problem that takes longer would be too large to search."""
MOST_WORKERS = 8
"""The most threads of a search, however many cores there are."""
MOST_PAIRS = 400_000
"""The most pairs of activities that change the same fact; their order is to be found."""

_WORKER = "skillc_runtime.planning.cp_sat.worker"


def find_cp_sat() -> tuple[str, ...] | None:
    """Return the command that searches for schedules, or None; the package is not imported."""
    return (sys.executable, "-m", _WORKER) if find_spec("ortools") is not None else None


class CpSat:
    """Runs the program in a temporary folder; callers must validate the schedules that it returns."""

    name = "CP-SAT"

    def __init__(self, command: Sequence[str], limits: Limits | None = None) -> None:
        self._command = tuple(command)
        self._limits = limits or machine_limits()

    def schedule(
        self,
        problem: Problem,
        first: Schedule | None,
        cancel: CancelToken,
        report: ReportProgress = ignore_progress,
    ) -> FoundSchedule | GaveUp:
        """Return the best schedule before `cancel` ends the search, which goes on from `first`.

        Activities may be repeated as often as in `first`, then once more, until that does not shorten the schedule.
        """
        try:
            activities = list_activities(problem, cancel.share(LISTING_SHARE))
            with make_workplace() as folder:
                return _Search(activities, self._command, self._limits, Path(folder), cancel, report).run(first)
        except NotSchedulable as why:
            return GaveUp(f"CP-SAT does not support the problem: {why}; the planners for --minimise work do")
        except Cancelled as why:
            return GaveUp(f"CP-SAT gave up: {why} before it knew all steps")
        except OSError as error:
            return GaveUp(f"CP-SAT cannot use its working folder: {error.filename}: {error.strerror}")


class _Search:
    def __init__(
        self,
        activities: Activities,
        command: tuple[str, ...],
        limits: Limits,
        folder: Path,
        cancel: CancelToken,
        report: ReportProgress,
    ) -> None:
        self._activities, self._command, self._limits, self._folder = activities, command, limits, folder
        self._cancel, self._report = cancel, report
        self._best: tuple[tuple[int, int], ...] | None = None
        self._at_least = 0

    def run(self, first: Schedule | None) -> FoundSchedule | GaveUp:
        """Search for schedules, and beside it for a bound where the search alone proves none for all plans."""
        workers = min(os.cpu_count() or 1, MOST_WORKERS)
        complete = self._activities.at_most_once
        with ExitStack() as beside:
            if not complete:
                workers = max(workers - 1, 1)
                beside.enter_context(self._start_bound(first))
            for repeats in count(1):
                before, failure = self._makespan, self._search(first, repeats, workers, complete)
                if failure is not None or complete or self._is_proved or self._makespan >= before:
                    break
        if self._best is None:
            return GaveUp(f"CP-SAT gave up: {failure or 'it found no schedule'}")
        at_least_s = self._at_least / float(self._activities.scale)
        return FoundSchedule(self._activities.schedule(self._best), at_least_s)

    @property
    def _makespan(self) -> float:
        return inf if self._best is None else self._makespan_of(self._best)

    @property
    def _is_proved(self) -> bool:
        return self._makespan <= self._at_least

    def _start_bound(self, first: Schedule | None) -> RunningProcess:
        task = self._activities.task(first, 1, self._seconds, 1)
        return self._start(replace(task, relaxed=True, first=()), "bound")

    @property
    def _seconds(self) -> float:
        return min(max(self._cancel.remaining_s - GRACE_S, 0.5 * self._cancel.remaining_s), MAX_S)

    def _start(self, task: ScheduleTask, name: str) -> RunningProcess:
        folder = self._folder / name
        folder.mkdir(exist_ok=True)
        (folder / TASK).write_bytes(msgspec.json.encode(task))
        (folder / ANSWER).unlink(missing_ok=True)
        return RunningProcess(self._command, folder, "output.txt", self._limits)

    def _search(self, first: Schedule | None, repeats: int, workers: int, complete: bool) -> str | None:
        """Search with activities that are done up to `repeats` times; return why nothing was found, or None."""
        task = self._activities.task(first, repeats, self._seconds, workers)
        pairs = _count_pairs(task)
        if pairs > MOST_PAIRS:
            return f"{pairs} pairs of steps change the same facts"
        if self._best is not None:
            task = replace(task, first=self._best)
        with self._start(task, "search") as search:
            proved = CancelToken(self._cancel.remaining_s, self._cancel)

            def look() -> None:
                self._look(complete)
                if self._is_proved:
                    proved.cancel("it is proved")

            wait_for_end((search,), proved, look)
            self._look(complete)
            return None if self._best is not None else _describe(search)

    def _look(self, complete: bool) -> None:
        """Take over what the programs have written down."""
        found, bound = self._read("search"), self._read("bound")
        if found is not None and found.starts is not None and self._makespan_of(found.starts) < self._makespan:
            self._best = found.starts
        bounds = [each.at_least for each in (found if complete else None, bound) if each is not None]
        self._at_least = max(self._at_least, *bounds, 0)
        scale = float(self._activities.scale)
        best_s = None if self._best is None else self._makespan / scale
        self._report(PlanningProgress(planner=CpSat.name, best_s=best_s, at_least_s=self._at_least / scale))

    def _makespan_of(self, starts: Sequence[tuple[int, int]]) -> int:
        return max((start + self._activities.activities[number].units for number, start in starts), default=0)

    def _read(self, name: str) -> ScheduleAnswer | None:
        try:
            return msgspec.json.decode((self._folder / name / ANSWER).read_bytes(), type=ScheduleAnswer)
        except (FileNotFoundError, msgspec.DecodeError):
            return None


def _count_pairs(task: ScheduleTask) -> int:
    """Return how many pairs of activities change the same fact."""
    writers: dict[int, int] = {}
    for each in task.activities:
        for literal in each.effects:
            writers[abs(literal)] = writers.get(abs(literal), 0) + each.copies
    return sum(number * number for number in writers.values() if number > 1)


def _describe(search: RunningProcess) -> str:
    match search.outcome():
        case ProcessEnded(0, _):
            return "it found no schedule"
        case ProcessEnded(code, output) as ended:
            if code < 0:
                return f"it was ended by signal {-code}"
            why = next((line for line in output.splitlines() if "Error" in line), ended.last_line)
            return f"it ended with code {code}, its output: {quote_line(why)}"
        case ProcessNotStarted(why):
            return f"it cannot be started ({why})"
        case _:
            return "it ran out of time"
