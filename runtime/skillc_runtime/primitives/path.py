"""Following a path with the tool."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from skillc_runtime.motion.path import path as path_through
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.arm_motion import ArmMotion

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell


class FollowPath(ArmMotion):
    """Move the tool through all poses of `path` at `speed` m/s; corners are cut by `blend` m at most."""

    def __init__(self, cell: Cell, *, arm: str, path: Sequence[Pose], speed: float, blend: float) -> None:
        super().__init__(cell, arm)
        self._poses, self._speed, self._blend = path, speed, blend

    def go(self) -> None:
        """Plan the path from where the reference rests, and go."""
        limits = self.limits(self._speed)
        self.arm.motion.move_along(path_through([self.arm.motion.stopping_pose(), *self._poses], limits, self._blend))
