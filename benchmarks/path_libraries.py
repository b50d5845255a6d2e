"""The search for joint paths beside RRT-Connect of OMPL, on the queries of `paths.py`: `pip install ompl` before.

OMPL has the same collision checks, bounds, number of samples and longest pieces. Its trees check pieces at equal
distances; its shortcuts, here as many as make paths as short as ours, check them as we do, which costs it less.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from itertools import pairwise
from statistics import mean, median
from time import process_time
from typing import Any

import numpy as np
from paths import QUERIES_A_CELL, Cell

from skillc_runtime.collision import path_planning
from skillc_runtime.collision.collision_checker import MIN_STEP_M, CollisionChecker
from skillc_runtime.collision.path_planning import JointSpace, NoPath, is_path_free, plan_joint_path
from skillc_runtime.collision.rrt_connect import LONGEST, Reach
from skillc_runtime.motion.pose import Array

SHORTCUTS = 15


def sample_with_ompl(contacts: CollisionChecker) -> Callable[..., list[Array] | None]:
    """Return a function in place of `sample_path`."""
    from ompl import base, geometric, util

    levers = contacts.model.levers
    util.setLogLevel(util.LogLevel.LOG_NONE)

    class FreeMotion(base.MotionValidator):  # type: ignore[misc]
        """Checks pieces with steps as long as the distances allow."""

        def __init__(self, information: Any, reach: Reach) -> None:
            super().__init__(information)
            self._reach = reach

        def checkMotion(self, one: Any, other: Any, *_: Any) -> bool:  # noqa: N802
            """Whether the way between two states is free."""
            return self._reach(read(one), read(other)) == 1.0

    def sample(reach: Reach, start: Array, goal: Array, bounds: Array, rounds: int, seed: int) -> list[Array] | None:
        util.RNG.setSeed(seed + 1)
        space, box = base.RealVectorStateSpace(len(start)), base.RealVectorBounds(len(start))
        for i, (low, high) in enumerate(bounds.tolist()):
            box.setLow(i, low)
            box.setHigh(i, high)
        space.setBounds(box)
        setup = geometric.SimpleSetup(space)
        information = setup.getSpaceInformation()
        setup.setStateValidityChecker(lambda state: contacts.find_collision(read(state) / levers) is None)
        step = max(contacts.model.margin, MIN_STEP_M)
        information.setStateValidityCheckingResolution(step / space.getMaximumExtent())
        setup.setStartAndGoalStates(*(write(space, each) for each in (start, goal)))
        planner = geometric.RRTConnect(information)
        planner.setRange(LONGEST * space.getMaximumExtent())
        setup.setPlanner(planner)
        left = iter(range(rounds))
        setup.solve(base.PlannerTerminationCondition(lambda: next(left, None) is None))
        if not setup.haveExactSolutionPath():
            return None
        path, shorter = setup.getSolutionPath(), setup.getPathSimplifier()
        information.setMotionValidator(FreeMotion(information, reach))
        shorter.reduceVertices(path)
        shorter.partialShortcutPath(path, SHORTCUTS, SHORTCUTS, 1.0)
        shorter.reduceVertices(path)
        return [read(path.getState(each)) for each in range(path.getStateCount())]

    def read(state: Any) -> Array:
        return np.array([state[i] for i in range(len(levers))])

    def write(space: Any, point: Array) -> Any:
        state = space.allocState()
        for i, each in enumerate(point.tolist()):
            state[i] = each
        return state

    return sample


def plan(cell: Cell, start: Array, goal: Array, with_ompl: bool) -> tuple[float, tuple[Array, ...] | None]:
    """Return the processor time in s, and the postures of a path, None without one."""
    contacts, own = cell.checker(), path_planning.sample_path
    began = process_time()
    if with_ompl:
        path_planning.sample_path = sample_with_ompl(contacts)
    try:
        way = plan_joint_path(contacts, start, [goal], JointSpace(cell.range, (cell.home,)))
    except NoPath:
        return process_time() - began, None
    finally:
        path_planning.sample_path = own
    seconds = process_time() - began
    assert is_path_free(contacts, (start, *way))
    return seconds, way


def measure(queries: int) -> str:
    """Return the figures of both, and their ratios."""
    times: tuple[list[float], list[float]] = [], []
    lengths: tuple[list[float], list[float]] = [], []
    solved = [0, 0]
    for number in range(queries):
        if number % QUERIES_A_CELL == 0:
            cell = Cell(number // QUERIES_A_CELL)
        start, goal = cell.posture(), cell.posture()
        found = [plan(cell, start, goal, bool(which)) for which in range(2)]
        for which, (seconds, way) in enumerate(found):
            times[which].append(seconds)
            solved[which] += way is not None
        ways = [way for _, way in found if way is not None]
        if len(ways) == 2:
            for which, way in enumerate(ways):
                lengths[which].append(sum(float(np.abs(b - a).sum()) for a, b in pairwise((start, *way))))
    lines = [
        f"{name}: {solved[which]} of {queries} solved, {1e3 * median(times[which]):.1f} ms in the median, "
        f"{1e3 * mean(times[which]):.1f} in the mean, {mean(lengths[which]):.2f} rad"
        for which, name in enumerate(("skillc", "OMPL"))
    ]
    ratios = [mean(lengths[1]) / mean(lengths[0]), *(each(times[1]) / each(times[0]) for each in (median, mean))]
    lines.append("OMPL / skillc: length {:.2f}, time {:.2f} in the median, {:.2f} in the mean".format(*ratios))
    return "\n".join(lines)


if __name__ == "__main__":
    print(measure(int(sys.argv[1]) if len(sys.argv) > 1 else 1000))
