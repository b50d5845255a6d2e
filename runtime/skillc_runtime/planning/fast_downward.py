"""Fast Downward, a program of its own: A* with LM-cut proves the optimum, LAMA finds a plan when time is short."""

from __future__ import annotations

import re
import sys
import time
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

from skillc_compiler.library.pddl.formulas import FALSE
from skillc_compiler.library.pddl.prepare import prepared
from skillc_compiler.library.pddl.problem import Problem
from skillc_compiler.library.pddl.text import domain_text, problem_text
from skillc_runtime.planning.plan import GaveUp, PlanResult, Solved, Unsolvable
from skillc_runtime.planning.process import Ended, NotStarted, OutOfTime, Run, run
from skillc_runtime.planning.steps import PlanTextError, plan_of

PROOF_SHARE = 0.7
"""The share of the time that goes to proving; the rest is LAMA's."""

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

    def __init__(self, programs: Programs) -> None:
        self._programs = programs

    def plan(self, problem: Problem, deadline_s: float) -> PlanResult:
        """Solve a problem; `best found` when the time was too short for a proof."""
        if problem.goal == FALSE:
            return Unsolvable("no skill can change what the goal asks for")
        with TemporaryDirectory(prefix="skillc-plan-") as name:
            return self._plan(prepared(problem), Path(name), time.monotonic() + deadline_s, deadline_s)

    def _plan(self, problem: Problem, folder: Path, end: float, seconds: float) -> PlanResult:
        (folder / "domain.pddl").write_text(domain_text(problem.domain), "utf-8")
        (folder / "problem.pddl").write_text(problem_text(problem), "utf-8")
        command = (*self._programs.translate, "--sas-file", "task.sas", "domain.pddl", "problem.pddl")
        translated = run(command, folder, end - time.monotonic())
        if not (folder / "task.sas").is_file():
            return GaveUp(f"Fast Downward did not take the problem: {_reason(translated)}")
        proof_end = end - (1.0 - PROOF_SHARE) * seconds
        proof = self._prove(problem, folder, proof_end, translated)
        if not isinstance(proof, GaveUp):
            return proof
        found = self._search_on(problem, folder, end)
        return found or proof

    def _prove(self, problem: Problem, folder: Path, end: float, translated: Run) -> PlanResult:
        heuristic = "lmcut()" if _axioms(translated) == 0 else "blind()"
        command = (self._programs.search, "--internal-plan-file", "proved", "--search", f"astar({heuristic})")
        searched = run(command, folder, end - time.monotonic(), folder / "task.sas")
        if isinstance(searched, Ended):
            if searched.code == 0 and (folder / "proved").is_file():
                return self._solved(problem, folder / "proved", proven=True)
            if searched.code in _UNSOLVABLE or (searched.code == 12 and _ALL_EXPLORED in searched.output):
                return Unsolvable("no sequence of skills reaches the goal")
        return GaveUp(f"Fast Downward gave up: {_reason(searched)}")

    def _search_on(self, problem: Problem, folder: Path, end: float) -> PlanResult | None:
        """Let LAMA look for any plan, better and better, until the time is up; the last plan file is the best."""
        left = end - time.monotonic()
        if left <= 0.0:
            return None
        options = ("--alias", "seq-sat-lama-2011", "--plan-file", "found", "task.sas")
        run((*self._programs.driver, *options), folder, left)
        plans = sorted(folder.glob("found*"), key=lambda path: int(path.suffix[1:] or 0))
        return self._solved(problem, plans[-1], proven=False) if plans else None

    def _solved(self, problem: Problem, file: Path, *, proven: bool) -> PlanResult:
        try:
            lines = file.read_text("utf-8").splitlines()
            actions = [tuple(line.strip("() ").split()) for line in lines if line.strip().startswith("(")]
            plan = plan_of(problem, actions)
        except (UnicodeDecodeError, PlanTextError) as error:
            return GaveUp(f"Fast Downward wrote something that is no plan: {error}")
        return Solved(plan, "proven" if proven else "best found", self.name)


def _axioms(translated: Run) -> int:
    said = translated.output if isinstance(translated, Ended) else ""
    found = re.search(r"Translator axioms: (\d+)", said)
    return int(found.group(1)) if found else 0


def _reason(outcome: Run) -> str:
    match outcome:
        case OutOfTime():
            return "its time was up"
        case NotStarted(why):
            return f"it cannot be started ({why})"
        case Ended(code, _):
            if code < 0:
                return f"it was ended by signal {-code}"
            return _CODES.get(code, f"it ended with code {code}, saying: {outcome.last_line}")
