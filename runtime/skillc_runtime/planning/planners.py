"""Finds the installed planners, the strongest first."""

from __future__ import annotations

from importlib.metadata import version

import msgspec

from skillc_runtime.planning.cache import CachingPlanner, CachingScheduler, PlanCache
from skillc_runtime.planning.cp_sat.solver import CpSat, find_cp_sat
from skillc_runtime.planning.fast_downward.solver import FastDownward, find_fast_downward
from skillc_runtime.planning.plan import Planner
from skillc_runtime.planning.process import machine_limits
from skillc_runtime.planning.schedule import Scheduler
from skillc_runtime.planning.search.astar import AStar

ADVICE = "the extra `planner` installs a stronger one"


class Planners(msgspec.Struct, frozen=True):
    """The planners that minimise work, the strongest first, and the scheduler that minimises the makespan, if any."""

    for_work: tuple[Planner, ...]
    for_makespan: Scheduler | None


def find_planners(cache: PlanCache | None = None) -> Planners:
    """Return the planners of this installation; answers of external programs are cached in `cache`."""
    strong = _fast_downward(cache)
    return Planners((*strong, AStar()) if strong else (AStar(ADVICE),), _cp_sat(cache))


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
