"""Moves the tool along a path."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from skillc_runtime.motion.paths.path import path_through as path_through
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.arm_motion import ArmMotion
from skillc_runtime.primitives.collision_free_motion import move_tool_along
from skillc_runtime.primitives.computation import Computing
from skillc_runtime.primitives.space_needs import Follow, SpaceNeed
from skillc_runtime.primitives.touch_guard import RESISTANCE_N

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell
    from skillc_runtime.world.state.values import Value
    from skillc_runtime.world.state.world_state import WorldState


class FollowPath(ArmMotion):
    """Moves the tool through all poses of `path` at `speed` m/s; corners are blended by at most `blend` m."""

    activity = "follow-path"
    targets = ("path",)

    @classmethod
    def needs_space(cls, arguments: Mapping[str, Value], state: WorldState) -> tuple[SpaceNeed, ...] | None:
        """Return that the tool follows the path."""
        arm, path = arguments.get("arm"), arguments.get("path")
        if not isinstance(arm, str) or not isinstance(path, tuple | list):
            return None
        return (Follow(arm, tuple(each for each in path if isinstance(each, Pose))),)

    def __init__(
        self,
        cell: Cell,
        *,
        arm: str,
        path: Sequence[Pose],
        speed: float,
        blend: float,
        resistance: float = RESISTANCE_N,
    ) -> None:
        super().__init__(cell, arm, resistance)
        self._individual = arm
        self._poses, self._speed, self._blend = path, speed, blend

    def start_motion(self) -> Computing:
        """Start the path from the stopping pose."""
        limits, motion = self.limits(self._speed), self.arm.motion
        yield from move_tool_along(
            self.cell,
            self._individual,
            lambda: path_through([motion.stopping_pose(), *self._poses], limits, self._blend),
        )
