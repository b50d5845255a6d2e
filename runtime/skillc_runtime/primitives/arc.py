"""Moves the tool along an arc."""

from __future__ import annotations

from typing import TYPE_CHECKING

from skillc_runtime.motion.paths.arc import arc_through
from skillc_runtime.motion.paths.path import join_segments
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Pose
from skillc_runtime.motion.reference import Trajectory
from skillc_runtime.primitives.arm_motion import ArmMotion
from skillc_runtime.primitives.collision_free_motion import move_tool_along
from skillc_runtime.primitives.computation import Computing
from skillc_runtime.primitives.place_description import describe_place
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.primitives.touch_guard import RESISTANCE_N

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell


class MoveArc(ArmMotion):
    """Moves the tool to `target` on the circle through the position of `via` at `speed` m/s, rotating on the way."""

    targets = ("via", "target")

    def __init__(
        self, cell: Cell, *, arm: str, via: Pose, target: Pose, speed: float, resistance: float = RESISTANCE_N
    ) -> None:
        super().__init__(cell, arm, resistance)
        self._individual = arm
        self._via, self._target, self._speed = via, target, speed

    def start_motion(self) -> Computing:
        """Start the arc from the stopping pose; SkillFailure if the positions define no circle."""
        limits = self.limits(self._speed)
        yield from move_tool_along(self.cell, self._individual, lambda: self._make_arc(limits))

    def _make_arc(self, limits: MotionLimits) -> Trajectory:
        """Return the arc from the stopping pose; SkillFailure if the positions define no circle."""
        start = self.arm.motion.stopping_pose()
        try:
            piece = arc_through(start, self._via.position, self._target, limits)
        except ValueError as why:
            state = self.cell.world.snapshot()
            places = (describe_place(state, pose.position) for pose in (start, self._via, self._target))
            raise SkillFailure("{}: start at {}; via at {}; target at {}".format(why, *places)) from why
        return join_segments([start, self._target], [piece], limits)
