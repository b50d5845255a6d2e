"""Runs Fast Downward: A*, which proves plans to be optimal, in parallel with LAMA, which finds plans fast."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from contextlib import ExitStack
from importlib.util import find_spec
from pathlib import Path

import msgspec

from skillc_model.pddl.formulas import FALSE
from skillc_model.pddl.preparing.complement import add_complements
from skillc_model.pddl.preparing.prepare import remove_axioms
from skillc_model.pddl.preparing.single_values import deny_other_values
from skillc_model.pddl.problem import Problem
from skillc_model.pddl.text import format_domain, format_problem
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.fast_downward.heuristics import Heuristic, choose_heuristics, read_task_features
from skillc_runtime.planning.fast_downward.progress import COST, SearchWatch, read_lower_bound
from skillc_runtime.planning.plan import GaveUp, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.plan_text import PlanTextError, cost_plan
from skillc_runtime.planning.process import (
    Limits,
    ProcessEnded,
    ProcessNotStarted,
    ProcessResult,
    ProcessTimedOut,
    RunningProcess,
    machine_limits,
    make_workplace,
    wait_for_end,
)
from skillc_runtime.planning.progress import ReportProgress, ignore_progress
from skillc_runtime.platforms.signals import FILE_TOO_LARGE

HEAD_START_S = 3.0
"""How much later LAMA starts than A*, which has solved most tasks by then: both together take twice the CPU time."""
HEAD_START_SHARE = 0.1
"""The most of the time that is left for which LAMA waits."""

MAX_COST = 2**30
"""The largest cost that is trusted: the planner's costs are 32-bit integers, which may overflow."""

_UNSOLVABLE = (10, 11)
_ALL_EXPLORED = "Completely explored state space"
_CODES = {
    12: "its search ended without an answer",
    20: "it ran out of memory while translating",
    21: "it ran out of time while translating",
    22: "it ran out of memory",
    23: "it ran out of time",
    24: "it ran out of memory and time",
    34: "the problem has a feature that its heuristic does not support",
}


class Programs(msgspec.Struct, frozen=True):
    """The programs of Fast Downward: translator and driver as commands, the search component as a file."""

    translate: tuple[str, ...]
    search: str
    driver: tuple[str, ...]


def find_fast_downward() -> Programs | None:
    """Return the programs of the installed package, or None; the package is not imported."""
    package, translator = find_spec("up_fast_downward"), find_spec("fast_downward")
    if package is None or package.origin is None or translator is None:
        return None
    folder = Path(package.origin).parent / "downward"
    search = folder / "builds/release/bin/downward"
    if not search.is_file():
        return None
    translate = (sys.executable, "-m", "fast_downward.translate")
    return Programs(translate, str(search), (sys.executable, str(folder / "fast-downward.py")))


def without_axioms(problem: Problem) -> Problem:
    """Return a problem as it is given to the program, which needs few or no axioms for it."""
    return remove_axioms(add_complements(deny_other_values(problem)))


class FastDownward:
    """Runs the programs in a temporary folder; the plan files decide, not the exit code."""

    name = "Fast Downward"

    def __init__(self, programs: Programs, limits: Limits | None = None) -> None:
        self._programs = programs
        self._limits = limits or machine_limits()

    def plan(self, problem: Problem, cancel: CancelToken, report: ReportProgress = ignore_progress) -> PlanResult:
        """Solve a problem before `cancel` ends the search; "best found" if there was no time for a proof."""
        if problem.goal == FALSE:
            return Unsolvable("no skill can change what the goal asks for")
        try:
            with make_workplace() as folder:
                plain = without_axioms(problem)
                return self._plan(plain, cancel, SearchWatch(self.name, plain, Path(folder), report))
        except OSError as error:
            return GaveUp(f"Fast Downward cannot use its working folder: {error.filename}: {error.strerror}")

    def _plan(self, problem: Problem, cancel: CancelToken, watch: SearchWatch) -> PlanResult:
        folder = watch.folder
        (folder / "domain.pddl").write_text(format_domain(problem.domain), "utf-8")
        (folder / "problem.pddl").write_text(format_problem(problem), "utf-8")
        command = (*self._programs.translate, "--sas-file", "task.sas", "domain.pddl", "problem.pddl")
        with RunningProcess(command, folder, "translated.txt", self._limits) as translator:
            wait_for_end((translator,), cancel)
            translated = translator.outcome()
        if not isinstance(translated, ProcessEnded) or not (folder / "task.sas").is_file():
            return GaveUp(f"Fast Downward did not accept the problem: {_describe_failure(translated)}")
        try:
            chosen = choose_heuristics(read_task_features(folder / "task.sas"))
        except ValueError:
            return GaveUp("Fast Downward did not accept the problem: its translator wrote an invalid task")
        return self._race(problem, cancel, chosen, watch)

    def _race(
        self, problem: Problem, cancel: CancelToken, chosen: Sequence[Heuristic], watch: SearchWatch
    ) -> PlanResult:
        """Return what A* proves with one heuristic after the other, or else the best plan of LAMA."""
        searched: list[ProcessResult] = []
        folder = watch.folder
        finding = ("--alias", "seq-sat-lama-2011", "--plan-file", "found", "task.sas")
        with ExitStack() as beside:
            finder: RunningProcess | None = None
            for index, heuristic in enumerate(chosen):
                command = (
                    self._programs.search,
                    "--internal-plan-file",
                    "proved",
                    "--search",
                    f"astar({heuristic.text})",
                )
                with RunningProcess(command, folder, f"proving{index}.txt", self._limits, folder / "task.sas") as proof:
                    if finder is None:
                        head_start = cancel.share(min(heuristic.share, HEAD_START_SHARE)).limited(HEAD_START_S)
                        wait_for_end((proof,), head_start, watch.look)
                        if not _has_proved(proof.outcome()) and cancel.reason is None:
                            finder = beside.enter_context(
                                RunningProcess((*self._programs.driver, *finding), folder, "finding.txt", self._limits)
                            )
                    wait_for_end((proof,), cancel.share(heuristic.share), watch.look)
                    searched.append(proof.outcome())
                    watch.look()
                if _has_proved(searched[-1]) or cancel.reason is not None:
                    break
            answer = _read_proof(problem, folder, searched[-1])
            if answer is None and finder is not None:
                wait_for_end((finder,), cancel, watch.look)
        return answer or _read_best_plan(problem, folder, searched)


def _has_proved(searched: ProcessResult) -> bool:
    if not isinstance(searched, ProcessEnded):
        return False
    explored = searched.code == 12 and _ALL_EXPLORED in searched.output
    return searched.code == 0 or searched.code in _UNSOLVABLE or explored


def _read_proof(problem: Problem, folder: Path, searched: ProcessResult) -> PlanResult | None:
    """Return what A* has proved, or None."""
    if not isinstance(searched, ProcessEnded) or not _has_proved(searched):
        return None
    if searched.code != 0:
        return Unsolvable("no sequence of skills reaches the goal")
    return _read_plan(problem, folder / "proved", None) if (folder / "proved").is_file() else None


def _read_best_plan(problem: Problem, folder: Path, searched: Sequence[ProcessResult]) -> PlanResult:
    """Return the last complete plan of LAMA, which is its best, with the lower bound that A* proved."""
    at_least = max(map(_read_bound, searched))
    plans = sorted(folder.glob("found*"), key=_plan_number)
    whole = [path for path in plans if COST.search(path.read_text("utf-8", "replace"))]
    if plans:
        return _read_plan(problem, (whole or plans)[-1], at_least)
    known = f"; any plan takes at least {float(at_least / problem.domain.scale):g} s" if at_least else ""
    return GaveUp(f"Fast Downward gave up: {_describe_failure(searched[-1])}{known}")


def _read_plan(problem: Problem, file: Path, at_least: int | None) -> PlanResult:
    """Return the plan in a file; it is optimal unless a lower bound `at_least` on the cost, in units, is given."""
    try:
        text = file.read_text("utf-8")
        actions = [tuple(line.strip("() ").split()) for line in text.splitlines() if line.strip().startswith("(")]
        found = cost_plan(problem, actions)
    except (UnicodeDecodeError, PlanTextError) as error:
        return GaveUp(f"Fast Downward wrote an invalid plan: {error}")
    stated = COST.search(text)
    if stated is None or int(stated.group(1)) != found.units:
        cost = f"costs {stated.group(1)}" if stated else "has no cost"
        return GaveUp(f"Fast Downward wrote an invalid plan: it {cost}, but its steps cost {found.units}")
    bound = found.units if at_least is None else at_least
    if bound < found.units or found.units > MAX_COST:
        known = float(bound / problem.domain.scale) if found.units <= MAX_COST else None
        return Solved(found.plan, "best found", FastDownward.name, at_least_s=known or None)
    if found.exact:
        return Solved(found.plan, "proven", FastDownward.name)
    least_s = found.at_least_s(problem)
    return Solved(found.plan, "optimal for approximate durations", FastDownward.name, at_least_s=least_s)


def _plan_number(file: Path) -> int:
    return int(file.suffix[1:]) if file.suffix[1:].isdigit() else 0


def _read_bound(searched: ProcessResult) -> int:
    return 0 if isinstance(searched, ProcessNotStarted) else read_lower_bound(searched.output)


def _describe_failure(outcome: ProcessResult) -> str:
    match outcome:
        case ProcessTimedOut():
            return "it ran out of time"
        case ProcessNotStarted(why):
            return f"it cannot be started ({why})"
        case ProcessEnded(code, _):
            if FILE_TOO_LARGE is not None and code == -FILE_TOO_LARGE:
                return "it exceeded the limit on file size"
            if code < 0:
                return f"it was ended by signal {-code}"
            return _CODES.get(code, f"it ended with code {code}, its output: {outcome.last_line}")
