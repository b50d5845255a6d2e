"""Finds the installed planners, the strongest first."""

from __future__ import annotations

from importlib.metadata import version
from pathlib import Path

from msgspec.structs import replace

from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.cache import CachingPlanner, CachingScheduler, PlanCache
from skillc_runtime.planning.cp_sat.solver import CpSat, find_cp_sat
from skillc_runtime.planning.fast_downward.solver import FastDownward, find_fast_downward, without_axioms
from skillc_runtime.planning.plan import Planner, PlanResult
from skillc_runtime.planning.process import machine_limits
from skillc_runtime.planning.progress import ReportProgress, ignore_progress
from skillc_runtime.planning.schedule import Planners, Scheduler
from skillc_runtime.planning.search.astar import AStar

ADVICE = "the extra `planner` installs a stronger one"
NAMES = {"fast-downward": FastDownward.name, "built-in": AStar.name}
"""The planners that minimise work, by the names with which a user chooses one."""


def find_planners(cache: PlanCache | None = None) -> Planners:
    """Return the planners of this installation; answers of external programs are cached in `cache`."""
    strong = _fast_downward(cache)
    return Planners((*strong, AStar()) if strong else (AStar(ADVICE),), _cp_sat(cache))


def choose_planner(planners: Planners, name: str) -> Planners:
    """Return planners of which only one minimises work, by its name in NAMES; LookupError if it is not installed."""
    chosen = tuple(each for each in planners.for_work if each.name == NAMES[name])
    if not chosen:
        raise LookupError(f"{NAMES[name]} is not installed; {ADVICE.replace('a stronger one', 'it')}")
    return replace(planners, for_work=chosen)


class WritingPlanner:
    """A planner each of whose problems is written as PDDL, as Fast Downward gets it, before it is solved."""

    def __init__(self, planner: Planner, folder: Path) -> None:
        self._planner, self._folder, self._count = planner, folder, 0

    @property
    def name(self) -> str:
        """The name that is shown to users."""
        return self._planner.name

    def plan(self, problem: Problem, cancel: CancelToken, report: ReportProgress = ignore_progress) -> PlanResult:
        """Write a problem and solve it; OSError if it cannot be written."""
        from skillc_model.pddl.text import format_domain, format_problem

        self._count += 1
        written = without_axioms(problem)
        for kind, text in (("domain", format_domain(written.domain)), ("problem", format_problem(written))):
            (self._folder / f"{kind}-{self._count}.pddl").write_text(text, "utf-8")
        return self._planner.plan(problem, cancel, report)


def list_planners() -> tuple[Planner, ...]:
    """Return the planners that minimise work, the strongest first; the built-in one is always among them."""
    return find_planners().for_work


def _fast_downward(cache: PlanCache | None) -> tuple[Planner, ...]:
    programs = find_fast_downward()
    if programs is None:
        return ()
    planner = FastDownward(programs)
    return (planner if cache is None else CachingPlanner(planner, cache, _identify_program("up-fast-downward")),)


def _cp_sat(cache: PlanCache | None) -> Scheduler | None:
    command = find_cp_sat()
    if command is None:
        return None
    scheduler = CpSat(command)
    return scheduler if cache is None else CachingScheduler(scheduler, cache, _identify_program("ortools"))


def _identify_program(package: str) -> str:
    """Return a text that identifies a program, its version and the memory that it may use."""
    return f"{package} {version(package)}, {machine_limits().memory_bytes} bytes"
