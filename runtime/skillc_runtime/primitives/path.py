"""Moves the tool along a path."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from skillc_runtime.motion.path import path_through as path_through
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.arm_motion import ArmMotion
from skillc_runtime.primitives.collision_free_motion import move_tool_along
from skillc_runtime.primitives.computation import Computing
from skillc_runtime.primitives.touch_guard import RESISTANCE_N

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell


class FollowPath(ArmMotion):
    """Moves the tool through all poses of `path` at `speed` m/s; corners are blended by at most `blend` m."""

    activity = "follow-path"
    targets = ("path",)

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
