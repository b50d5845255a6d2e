"""Fast Downward, a program of its own: A* with LM-cut, which proves the optimum, and LAMA, which finds plans, race."""

from __future__ import annotations

import re
import signal
import sys
import time
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from skillc_compiler.library.pddl.complement import complemented
from skillc_compiler.library.pddl.formulas import FALSE
from skillc_compiler.library.pddl.prepare import prepared
from skillc_compiler.library.pddl.problem import Problem
from skillc_compiler.library.pddl.text import domain_text, problem_text
from skillc_runtime.planning.plan import GaveUp, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.process import (
    Ended,
    Limits,
    NotStarted,
    OutOfTime,
    Run,
    Running,
    machine_limits,
    wait,
    workplace,
)
from skillc_runtime.planning.steps import PlanTextError, plan_of

HEAD_START_S = 0.2
"""LAMA starts so much later than A*: most tasks are solved by then."""

_COST = re.compile(r"^; cost = (\d+)", re.MULTILINE)
_PROVED = re.compile(r"\bf = (\d+)")
_UNSOLVABLE = (10, 11)
_ALL_EXPLORED = "Completely explored state space"
_CODES = {
    12: "it searched everything it could without an answer",
    20: "it ran out of memory while translating",
    21: "it ran out of time while translating",
    22: "it ran out of memory",
    23: "it ran out of time",
    24: "it ran out of memory and time",
    34: "the problem has a feature that its heuristic does not support",
}


@dataclass(frozen=True, slots=True)
class Programs:
    """The programs of Fast Downward: translator and driver as commands, the search component as a file."""

    translate: tuple[str, ...]
    search: str
    driver: tuple[str, ...]


def installed() -> Programs | None:
    """Return the programs of the installed package, None where there is none; nothing of it is imported."""
    package, translator = find_spec("up_fast_downward"), find_spec("fast_downward")
    if package is None or package.origin is None or translator is None:
        return None
    folder = Path(package.origin).parent / "downward"
    search = folder / "builds/release/bin/downward"
    if not search.is_file():
        return None
    translate = (sys.executable, "-m", "fast_downward.translate")
    return Programs(translate, str(search), (sys.executable, str(folder / "fast-downward.py")))


class FastDownward:
    """Solves a problem in a temporary folder; only plan files count, whatever the program's exit code says."""

    name = "Fast Downward"

    def __init__(self, programs: Programs, limits: Limits | None = None) -> None:
        self._programs = programs
        self._limits = limits or machine_limits()

    def plan(self, problem: Problem, deadline_s: float) -> PlanResult:
        """Solve a problem; `best found` when the time was too short for a proof."""
        if problem.goal == FALSE:
            return Unsolvable("no skill can change what the goal asks for")
        end = time.monotonic() + deadline_s
        try:
            with workplace() as folder:
                return self._plan(prepared(complemented(problem)), Path(folder), end)
        except OSError as error:
            return GaveUp(f"Fast Downward has no place to work in: {error.filename}: {error.strerror}")

    def _plan(self, problem: Problem, folder: Path, end: float) -> PlanResult:
        (folder / "domain.pddl").write_text(domain_text(problem.domain), "utf-8")
        (folder / "problem.pddl").write_text(problem_text(problem), "utf-8")
        command = (*self._programs.translate, "--sas-file", "task.sas", "domain.pddl", "problem.pddl")
        with Running(command, folder, "translated.txt", self._limits) as translator:
            wait((translator,), end)
            translated = translator.outcome()
        if not isinstance(translated, Ended) or not (folder / "task.sas").is_file():
            return GaveUp(f"Fast Downward did not take the problem: {_reason(translated)}")
        return self._race(problem, folder, end, "lmcut()" if _axioms(translated.output) == 0 else "blind()")

    def _race(self, problem: Problem, folder: Path, end: float, heuristic: str) -> PlanResult:
        proving = (self._programs.search, "--internal-plan-file", "proved", "--search", f"astar({heuristic})")
        with Running(proving, folder, "proving.txt", self._limits, folder / "task.sas") as proof:
            wait((proof,), min(end, time.monotonic() + HEAD_START_S))
            answer = _proved(problem, folder, proof.outcome())
            if answer is not None or time.monotonic() >= end:
                return answer or _best(problem, folder, proof.outcome())
            finding = ("--alias", "seq-sat-lama-2011", "--plan-file", "found", "task.sas")
            with Running((*self._programs.driver, *finding), folder, "finding.txt", self._limits) as finder:
                wait((proof,), end)
                answer = _proved(problem, folder, proof.outcome())
                if answer is None:
                    wait((finder,), end)
        return answer or _best(problem, folder, proof.outcome())


def _proved(problem: Problem, folder: Path, searched: Run) -> PlanResult | None:
    """Return what A* has proved, None as long as it has proved nothing."""
    if isinstance(searched, Ended):
        if searched.code == 0 and (folder / "proved").is_file():
            return _solved(problem, folder / "proved", None)
        if searched.code in _UNSOLVABLE or (searched.code == 12 and _ALL_EXPLORED in searched.output):
            return Unsolvable("no sequence of skills reaches the goal")
    return None


def _best(problem: Problem, folder: Path, searched: Run) -> PlanResult:
    """Return the last whole plan that LAMA wrote, each is better than the one before; with the bound that A* proved."""
    at_least = _bound(searched)
    plans = sorted(folder.glob("found*"), key=_number)
    whole = [path for path in plans if _COST.search(path.read_text("utf-8", "replace"))]
    if plans:
        return _solved(problem, (whole or plans)[-1], at_least)
    known = f"; any plan takes at least {at_least / problem.domain.scale:g} s" if at_least else ""
    return GaveUp(f"Fast Downward gave up: {_reason(searched)}{known}")


def _solved(problem: Problem, file: Path, at_least: int | None) -> PlanResult:
    """Return the plan in a file, proven to be the shortest unless only a bound on the cost is known, in units."""
    try:
        text = file.read_text("utf-8")
        actions = [tuple(line.strip("() ").split()) for line in text.splitlines() if line.strip().startswith("(")]
        plan = plan_of(problem, actions)
    except (UnicodeDecodeError, PlanTextError) as error:
        return GaveUp(f"Fast Downward wrote something that is no plan: {error}")
    told, units = _COST.search(text), round(plan.duration_s * problem.domain.scale)
    if told is None or int(told.group(1)) != units:
        said = f"costs {told.group(1)}" if told else "has no cost"
        return GaveUp(f"Fast Downward wrote something that is no plan: it {said}, but its steps cost {units}")
    if at_least is None or units <= at_least:
        return Solved(plan, "proven", FastDownward.name)
    return Solved(plan, "best found", FastDownward.name, at_least_s=at_least / problem.domain.scale)


def _number(file: Path) -> int:
    return int(file.suffix[1:]) if file.suffix[1:].isdigit() else 0


def _bound(searched: Run) -> int:
    """Return the least cost that any plan can have, as far as A* had come; in units."""
    said = "" if isinstance(searched, NotStarted) else searched.output
    return max(map(int, _PROVED.findall(said)), default=0)


def _axioms(said: str) -> int:
    found = re.search(r"Translator axioms: (\d+)", said)
    return int(found.group(1)) if found else 0


def _reason(outcome: Run) -> str:
    match outcome:
        case OutOfTime():
            return "its time was up"
        case NotStarted(why):
            return f"it cannot be started ({why})"
        case Ended(code, _):
            if code == -signal.SIGXFSZ:
                return "it wrote more into a file than it may"
            if code < 0:
                return f"it was ended by signal {-code}"
            return _CODES.get(code, f"it ended with code {code}, saying: {outcome.last_line}")
