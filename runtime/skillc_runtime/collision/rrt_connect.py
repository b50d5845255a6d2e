"""A path around obstacles by RRT-Connect of OMPL, shortened; the extra `motion` installs OMPL.

J. J. Kuffner, S. M. LaValle, RRT-Connect: an efficient approach to single-query path planning, ICRA 2000. It ends
after a number of checks, not after a time, so the same seed gives the same path on every machine.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from skillc_runtime.motion.pose import Array

ROUNDS = 4
"""Number of times a path is shortened."""


class SamplerMissing(Exception):
    """OMPL is not installed."""


def sample_path(
    free: Callable[[Array], bool], start: Array, goal: Array, bounds: Array, step: float, most: int, seed: int
) -> list[Array] | None:
    """Return the points (n,) of a path from start to goal whose straight segments are free, None if none was found.

    bounds (n, 2) contain start and goal; segments are checked every `step`, in the units of the points, with `most`
    checks in total; seed > 0. Raises SamplerMissing without OMPL.
    """
    try:
        from ompl import base, geometric, util
    except ImportError as missing:
        raise SamplerMissing from missing
    util.setLogLevel(util.LogLevel.LOG_NONE)
    util.RNG.setSeed(seed)
    size, looks = len(start), _Checks(free, most)
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


class _Checks:
    """Checks points, and counts the checks."""

    def __init__(self, free: Callable[[Array], bool], most: int) -> None:
        self._free, self._left = free, most

    def free(self, point: Array) -> bool:
        """Return whether a point is free."""
        self._left -= 1
        return self._free(point)

    def spent(self) -> bool:
        """Return whether all checks have been used."""
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
