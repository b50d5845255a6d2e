"""Which planner is used: the first of those that are there."""

from __future__ import annotations

from skillc_runtime.planning.astar import AStar
from skillc_runtime.planning.fast_downward import FastDownward, installed
from skillc_runtime.planning.plan import Planner


def available() -> tuple[Planner, ...]:
    """Return the planners of this installation, the strongest first; the built-in one is always there."""
    programs = installed()
    return (FastDownward(programs), AStar()) if programs else (AStar(),)
