"""`canReach`: an arm reaches a surface from where its robot works on it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.world.space.frame_tree import frame_tree_of
from skillc_runtime.world.space.reach import reach_obstacle
from skillc_runtime.world.state.terms import HAS_ARM, HOLDS_DEEP, MOBILE_ROBOT, WORKSTATION

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


class CanReach:
    """The arm reaches the surface from where its robot stands or, for a mobile robot, from a workstation.

    That is the workstation that contains the surface, or any workstation if none does. Surfaces and fixed robots do not
    move, and arms stay on their robots, so the result is the same after a plan as before it.
    """

    def obstacle(self, state: WorldState, subject: str, object_: str) -> str | None:
        """Return by how much the surface is out of reach from each place; None when the arm reaches it from one."""
        space, short = frame_tree_of(state), state.vocabulary.short
        base = space.pose(subject)
        robot = min(state.subjects(HAS_ARM, subject), default=None)
        if robot is None or not state.is_a(robot, MOBILE_ROBOT):
            return reach_obstacle(state, subject, base, object_)
        stations = _stations(state, object_)
        if not stations:
            return f"there is no workstation at which {short(robot)} could stand"
        mounted, obstacles = space.pose(robot).inverse() @ base, []
        for station in stations:
            obstacle = reach_obstacle(state, subject, space.pose(station) @ mounted, object_)
            if obstacle is None:
                return None
            obstacles.append(f"at {short(station)}: {obstacle}")
        return "; ".join(obstacles)


def _stations(state: WorldState, surface: str) -> list[str]:
    stations = state.instances(WORKSTATION)
    return sorted(stations & state.subjects(HOLDS_DEEP, surface) or stations)
