"""Finds schedules with aries: with one instance of each action, then two, and so on."""

from __future__ import annotations

import platform
import re
from dataclasses import replace
from importlib.util import find_spec
from itertools import count
from pathlib import Path

import msgspec
from msgspec import structs

from skillc_model.pddl.costs import MOST_UNITS
from skillc_model.pddl.problem import Problem, action_durations
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.aries.flat import FlatProblem, NotTemporal, flatten_problem
from skillc_runtime.planning.aries.messages import action_name, encode_problem
from skillc_runtime.planning.plan import GaveUp
from skillc_runtime.planning.plan_text import PlanTextError, read_step
from skillc_runtime.planning.process import (
    Limits,
    ProcessEnded,
    ProcessNotStarted,
    ProcessResult,
    ProcessTimedOut,
    RunningProcess,
    machine_limits,
    make_workplace,
    quote_line,
    wait_for_end,
)
from skillc_runtime.planning.progress import PlanningProgress, ReportProgress, ignore_progress
from skillc_runtime.planning.schedule import Schedule, TimedStep

PROGRAMS = {
    ("Linux", "x86_64"): "up-aries_linux_amd64",
    ("Darwin", "x86_64"): "up-aries_macos_amd64",
    ("Darwin", "arm64"): "up-aries_macos_arm64",
}
GRACE_S = 0.5
"""How long aries may take after its time limit to print its best schedule."""
MAX_S = 86_400
"""The longest time limit that it is given."""

_ENVIRONMENT = {"ARIES_LCP_SYMMETRY_BREAKING": "simple"}
"""The default symmetry breaking of version 0.5.0 panics on many problems."""

_NO_PLAN = "NO PLAN"
_LINE = re.compile(r"^ *(\d+\.?\d*): \((\S+)((?: [^\s()]+)*)\) \[(\d+\.?\d*)\]$", re.MULTILINE)


def find_aries() -> str | None:
    """Return the program of the installed package, or None; the package is not imported."""
    package, name = find_spec("up_aries"), PROGRAMS.get((platform.system(), platform.machine()))
    if package is None or package.origin is None or name is None:
        return None
    program = Path(package.origin).parent / "bin" / name
    return str(program) if program.is_file() else None


class _NoSchedule(msgspec.Struct, frozen=True):
    """There is no schedule with this number of instances of each action."""


class Aries:
    """Runs the program in a temporary folder; callers must validate the schedules that it returns."""

    name = "aries"

    def __init__(self, program: str, limits: Limits | None = None) -> None:
        self._program = program
        self._limits = limits or machine_limits()

    def schedule(
        self, problem: Problem, cancel: CancelToken, report: ReportProgress = ignore_progress
    ) -> Schedule | GaveUp:
        """Return the best schedule before `cancel` ends the search; stop when one more instance does not shorten it."""
        try:
            flat = flatten_problem(_with_finer_units(problem))
            with make_workplace() as folder:
                (Path(folder) / "problem.upp").write_bytes(encode_problem(flat))
                return self._search_all_depths(flat, Path(folder), cancel, report)
        except NotTemporal as why:
            return GaveUp(f"aries does not support the problem: {why}; the planners for --minimise work do")
        except OSError as error:
            return GaveUp(f"aries cannot use its working folder: {error.filename}: {error.strerror}")

    def _search_all_depths(
        self, flat: FlatProblem, folder: Path, cancel: CancelToken, report: ReportProgress
    ) -> Schedule | GaveUp:
        answer: Schedule | _NoSchedule | GaveUp = _NoSchedule()
        depths = count(1)
        report(PlanningProgress(planner=self.name))
        while isinstance(answer, _NoSchedule):
            answer = self._search_depth(next(depths), flat, folder, cancel)
        while isinstance(answer, Schedule):
            report(PlanningProgress(planner=self.name, best_s=answer.makespan_s))
            deeper = self._search_depth(next(depths), flat, folder, cancel)
            if not isinstance(deeper, Schedule) or deeper.makespan_s >= answer.makespan_s:
                return answer
            answer = deeper
        return answer

    def _search_depth(
        self, depth: int, flat: FlatProblem, folder: Path, cancel: CancelToken
    ) -> Schedule | _NoSchedule | GaveUp:
        seconds = int(min(cancel.remaining_s, MAX_S))
        if seconds < 1:
            return GaveUp("aries gave up: it ran out of time")
        searching = ("solve", "--optimal", "--min-depth", str(depth), "--max-depth", str(depth))
        command = (self._program, "--log-level", "error", *searching, "--timeout", str(seconds), "problem.upp")
        with RunningProcess(command, folder, "output.txt", self._limits, environment=_ENVIRONMENT) as search:
            wait_for_end((search,), CancelToken(cancel.remaining_s + GRACE_S, cancel))
            return _read_result(search.outcome(), flat)


def _with_finer_units(problem: Problem) -> Problem:
    """Return the problem with finer units, as aries leaves gaps of 0.1 units between steps."""
    domain = problem.domain
    longest = max(map(domain.units, action_durations(problem)), default=0)
    finer = 10 if 10 * longest <= MOST_UNITS else 1
    return structs.replace(problem, domain=replace(domain, scale=finer * domain.scale))


def _read_result(outcome: ProcessResult, flat: FlatProblem) -> Schedule | _NoSchedule | GaveUp:
    match outcome:
        case ProcessEnded(0, output) if _LINE.search(output):
            return _read_schedule(output, flat)
        case ProcessEnded(0, output) if _NO_PLAN in output:
            return _NoSchedule()
        case ProcessEnded(code, output):
            panics = (quote_line(line) for line in output.splitlines() if "panicked" in line)
            panic = next(panics, outcome.last_line)
            how = f"was ended by signal {-code}" if code < 0 else f"ended with code {code}, its output: {panic}"
            return GaveUp(f"aries gave up: it {how}")
        case ProcessNotStarted(why):
            return GaveUp(f"aries cannot be started ({why})")
        case ProcessTimedOut():
            return GaveUp("aries gave up: it ran out of time")


def _read_schedule(output: str, flat: FlatProblem) -> Schedule | GaveUp:
    """Return the schedule that aries printed, with times in s."""
    actions = {action_name(index): each.action for index, each in enumerate(flat.actions)}
    steps = []
    for start, name, words, duration in _LINE.findall(output):
        if name not in actions:
            return GaveUp(f"aries printed an invalid plan: `{name}` is not an action of the problem")
        action, scale = actions[name], float(flat.problem.domain.scale)
        try:
            step = read_step(flat.problem, (action.name, *words.split()[: len(action.parameters)]))
        except PlanTextError as error:
            return GaveUp(f"aries printed an invalid plan: {error}")
        if step is not None:
            steps.append(TimedStep(step, float(start) / scale, float(duration) / scale))
    return Schedule(tuple(sorted(steps, key=lambda each: each.start_s)))
