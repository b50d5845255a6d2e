"""A way around obstacles by sampling: RRT-Connect of OMPL, shortened; the extra `motion` installs it.

J. J. Kuffner, S. M. LaValle, RRT-Connect: an efficient approach to single-query path planning, ICRA 2000. Ended by the
number of postures that were looked at, not by a clock: the same seed gives the same way on every machine.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from skillc_runtime.motion.pose import Array

ROUNDS = 4
"""How often a way is shortened."""


class SamplerMissing(Exception):
    """OMPL is not installed."""


def sample_path(
    free: Callable[[Array], bool], start: Array, goal: Array, bounds: Array, step: float, most: int, seed: int
) -> list[Array] | None:
    """Return points (n,) on a way from start to goal whose straight pieces are free, None when none was found.

    bounds (n, 2) hold start and goal; pieces are looked at every `step`, in the units of the points, at `most` so many
    times; seed > 0. NoSampler without OMPL.
    """
    try:
        from ompl import base, geometric, util
    except ImportError as missing:
        raise SamplerMissing from missing
    util.setLogLevel(util.LogLevel.LOG_NONE)
    util.RNG.setSeed(seed)
    size, looks = len(start), _Looks(free, most)
    space = base.RealVectorStateSpace(size)
    space.setBounds(_bounds(base.RealVectorBounds(size), bounds))
    known = base.SpaceInformation(space)
    known.setStateValidityChecker(lambda state: looks.free(_point(state, size)))
    known.setStateValidityCheckingResolution(step / space.getMaximumExtent())
    known.setup()
    problem, planner = base.ProblemDefinition(known), geometric.RRTConnect(known)
    problem.setStartAndGoalStates(_state(space, start), _state(space, goal))
    planner.setProblemDefinition(problem)
    planner.setup()
    planner.solve(base.PlannerTerminationCondition(looks.spent))
    if not problem.hasExactSolution():
        return None
    path = problem.getSolutionPath()
    _shorten(geometric.PathSimplifier(known), path)
    inner = [_point(state, size) for state in path.getStates()[1:-1]]
    return [start, *inner, goal]


class _Looks:
    """Tells which points are free, and when enough of them were looked at."""

    def __init__(self, free: Callable[[Array], bool], most: int) -> None:
        self._free, self._left = free, most

    def free(self, point: Array) -> bool:
        """Whether a point is free."""
        self._left -= 1
        return self._free(point)

    def spent(self) -> bool:
        """Whether enough points were looked at."""
        return self._left <= 0


def _shorten(simplifier: Any, path: Any) -> None:
    for _ in range(ROUNDS):
        simplifier.reduceVertices(path)
        simplifier.partialShortcutPath(path)
    simplifier.reduceVertices(path)


def _bounds(bounds: Any, limits: Array) -> Any:
    for index, (low, high) in enumerate(limits.tolist()):
        bounds.setLow(index, low)
        bounds.setHigh(index, high)
    return bounds


def _state(space: Any, point: Array) -> Any:
    state = space.allocState()
    for index, value in enumerate(point.tolist()):
        state[index] = value
    return state


def _point(state: Any, size: int) -> Array:
    return np.array([state[index] for index in range(size)])
