"""Schedules beside published optima: the makespan, what is proved of it, and the CPU time that it takes.

Run it as `python benchmarks/schedules.py [SECONDS]`, the deadline of each instance, 30 by default. It needs the extras
`planner` and `temporal`. `found/optimum` is the ratio to the published optimum, `bound/optimum` that of what is proved
of all plans; job shops are to be within BOUND in 30 s on two quiet cores. `serial` is the makespan of all steps one
after the other, `cpu` the processor time of all processes, in seconds: the deadline is one of wall-clock time.
"""

from __future__ import annotations

import resource
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))

import _robot_cells

from planners import job_shops
from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.makespan.minimise import minimise_makespan
from skillc_runtime.planning.planners import find_planners
from skillc_runtime.planning.schedule import Scheduled
from skillc_runtime.world.state.world_state import WorldState

BOUND = 1.02
RANDOM = 3
"""How many random job shops follow, whose optimum nobody has published."""


def main() -> None:
    """Schedule each instance and print a line for it."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 30.0
    heads = {"optimum": 9, "found": 8, "bound": 8, "serial": 8, "found/optimum": 15, "bound/optimum": 15, "cpu": 7}
    print(f"{'':>10}{''.join(f'{name:>{width}}' for name, width in heads.items())}")
    shop = job_shops.compile_shop()
    shops = {**job_shops.PUBLISHED, **{f"10x10 {seed}": job_shops.JobShop.draw(10, 10, seed) for seed in range(RANDOM)}}
    for name, each in shops.items():
        _measure(name, each.optimum, (shop, job_shops.make_world(each, shop), job_shops.make_goal(each)), seconds)
    cell = _robot_cells.compile_cell()
    for name, one in _robot_cells.PUBLISHED.items():
        problem = (cell, _robot_cells.make_world(one, cell), _robot_cells.make_goal(one))
        _measure(name, one.optimum, problem, seconds)


def _measure(
    name: str, optimum: int | None, problem: tuple[SkillLibrary, WorldState, Condition], seconds: float
) -> None:
    before = _cpu_s()
    answer = minimise_makespan(*problem, find_planners(), CancelToken(seconds))
    cpu_s = _cpu_s() - before
    if not isinstance(answer, Scheduled):
        print(f"{name:>10}{optimum or '-':>9}   {answer.message}")
        return
    found_s = answer.schedule.makespan_s
    bound_s = found_s if answer.optimal == "proven" else answer.at_least_s or 0.0
    ratios = "".join(f"{each / optimum:15.3f}" if optimum else f"{'-':>15}" for each in (found_s, bound_s))
    held = "" if optimum is None or found_s <= BOUND * optimum else "  BROKEN"
    line = f"{name:>10}{optimum or '-':>9}{found_s:8.0f}{bound_s:8.0f}{answer.plan.duration_s:8.0f}"
    print(f"{line}{ratios}{cpu_s:7.1f}{held}", flush=True)


def _cpu_s() -> float:
    """Return the processor time of this process and of all that it has waited for, in s."""
    usages = map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(each.ru_utime + each.ru_stime for each in usages)


if __name__ == "__main__":
    main()
