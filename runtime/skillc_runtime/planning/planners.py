"""Which planners are used: those that are there, the strongest first."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.metadata import version

from skillc_runtime.planning.aries.solver import Aries, find_aries
from skillc_runtime.planning.cache import CachingPlanner, CachingScheduler, PlanCache
from skillc_runtime.planning.fast_downward.solver import FastDownward, find_fast_downward
from skillc_runtime.planning.plan import Planner
from skillc_runtime.planning.process import machine_limits
from skillc_runtime.planning.schedule import Scheduler
from skillc_runtime.planning.search.astar import AStar

ADVICE = "the extra `planner` installs a stronger one"


@dataclass(frozen=True, slots=True)
class Planners:
    """The planners for the least work, the strongest first, and the one for an early end, if there is one."""

    for_work: tuple[Planner, ...]
    for_makespan: Scheduler | None


def find_planners(shelf: PlanCache | None = None) -> Planners:
    """Return the planners of this installation; what they answer is kept on the shelf and found there again."""
    strong = _fast_downward(shelf)
    return Planners((*strong, AStar()) if strong else (AStar(ADVICE),), _aries(shelf))


def list_planners() -> tuple[Planner, ...]:
    """Return the planners for the least work, the strongest first; the built-in one is always there."""
    return find_planners().for_work


def _fast_downward(shelf: PlanCache | None) -> tuple[Planner, ...]:
    programs = find_fast_downward()
    if programs is None:
        return ()
    planner = FastDownward(programs)
    return (planner if shelf is None else CachingPlanner(planner, shelf, _who("up-fast-downward")),)


def _aries(shelf: PlanCache | None) -> Scheduler | None:
    program = find_aries()
    if program is None:
        return None
    scheduler = Aries(program)
    return scheduler if shelf is None else CachingScheduler(scheduler, shelf, _who("up-aries"))


def _who(package: str) -> str:
    """Return what an answer depends on besides the problem and the time: the program and the memory it may use."""
    return f"{package} {version(package)}, {machine_limits().memory_bytes} bytes"
