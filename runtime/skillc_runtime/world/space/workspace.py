"""The workspace of an arm: the box that its tool must not leave, as far as it is known from facts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.frames import moves_with, pose, size
from skillc_runtime.world.state.terms import HAS_ARM, HAS_WORKSPACE, MOBILE_ROBOT

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


def distance_outside_workspace(state: WorldState, arm: str, point: Array) -> float:
    """Return how far a point (3,) m in the world is outside the workspace of an arm, in m; 0 inside or without one.

    A workspace moves with the base of its arm. Of a mobile robot it is known only if its frame moves with the robot;
    0 otherwise. FrameError when a pose is not known.
    """
    space = min(state.objects(arm, HAS_WORKSPACE), default=None)
    if space is None or any(
        state.is_a(robot, MOBILE_ROBOT) and not moves_with(state, space, robot)
        for robot in state.subjects(HAS_ARM, arm)
    ):
        return 0.0
    pose(state, arm)
    local = pose(state, space).inverse().apply(point)
    return float(np.linalg.norm(np.maximum(np.abs(local) - size(state, space) / 2, 0.0)))
