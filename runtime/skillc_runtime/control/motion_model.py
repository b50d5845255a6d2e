"""The motions that an arm can make from where it is, computed without the arm: also in another process."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

import msgspec
import numpy as np

from skillc_runtime.control.feasibility import sample_offsets
from skillc_runtime.control.kinematics import Kinematics
from skillc_runtime.control.supervision.safety import Workspace
from skillc_runtime.devices.arm import ArmLimits, ArmState
from skillc_runtime.devices.motion_interface import Infeasible, ToolMotion
from skillc_runtime.motion.paths.joint import JointTrajectory
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Overlay, Trajectory

SAMPLE_S, MAX_SAMPLES = 0.02, 1000
"""Time between samples of a motion, and their greatest number."""

TOLERANCE_M = 1e-4
"""How far a motion may leave the workspace because of rounding."""


def sample_times(duration_s: float) -> Array:
    """Return the times (n,) in s at which a motion is checked, from its start to its end."""
    count = int(np.clip(np.ceil(duration_s / SAMPLE_S), 1, MAX_SAMPLES))
    return np.linspace(0.0, duration_s, count + 1)


def check_motion_inside(workspace: Workspace, points: Iterable[Array]) -> None:
    """Raise Infeasible if a motion of the tool through one or more points (3,), m in base, leaves the workspace.

    A tool that is outside may only come back: it must not go farther away, and be inside at the end.
    """
    places = [(workspace.outside(point), point) for point in points]
    for (before, _), (outside, point) in pairwise(places):
        if outside > before + TOLERANCE_M:
            raise _outside(outside, point)
    if places[-1][0] > TOLERANCE_M:
        raise _outside(*places[-1])


def _outside(distance_m: float, point: Array) -> Infeasible:
    return Infeasible(f"its tool would be {1e3 * distance_m:.0f} mm outside the arm's workspace", point)


class ArmMotionModel(msgspec.Struct, frozen=True):
    """Implements `MotionModel` for an arm as it was at one instant.

    base: in the world. start, now (nv,): rad, where the joints come to rest, and from where a motion of the tool
    continues. tool_speed_m_s: the greatest speed of the tool in a motion of the joints.
    """

    kinematics: Kinematics
    limits: ArmLimits
    workspace: Workspace | None
    state: ArmState
    base: Pose
    start: Array
    now: Array
    tool_speed_m_s: float

    def inverse_kinematics(self, target: Pose, seed: Array) -> Array | None:
        """Return joints (nv,) in rad, near `seed`, with the tool at `target` in the world; None if there are none."""
        in_base = self.base.inverse() @ target
        return self.kinematics.inverse_kinematics(in_base, seed, self.limits.range, self.state)

    def rank_postures(self, target: Pose, rest: Array) -> Array:
        """Return postures (n, nv) in rad with the tool at `target` in the world, the best first: near `rest` (nv,)."""
        in_base = self.base.inverse() @ target
        return self.kinematics.rank_postures(in_base, rest, self.limits.range, self.state)

    def joint_motion(self, way: Sequence[Array], share: float, blend: float = 0.0) -> JointTrajectory:
        """Return the motion of the joints from `start` through postures.

        Infeasible if the tool would leave its workspace.
        way: postures, each (nv,) in rad.
        share: above 0 to 1, the share of the greatest joint speeds; reduced if the tool would be too fast.
        blend: share, 0 to 1, of the possible overlap at each intermediate posture; the motion stops there at 0.
        """
        postures, speed = (self.start, *way), self.tool_speed_m_s
        motion = self.kinematics.joint_path(postures, self.limits, share, speed, blend, self.state)
        if self.workspace is not None:
            sampled = (motion.at(float(time)).q for time in sample_times(motion.duration))
            check_motion_inside(self.workspace, self.kinematics.tool_positions(sampled, self.state))
        return motion

    def tool_motion(self, trajectory: Trajectory) -> ToolMotion:
        """Return the motion of the tool along a trajectory in the world; Infeasible if the arm cannot follow it.

        It is slowed down if a joint would be too fast.
        """
        local = trajectory.transform(self.base.inverse())
        if self.workspace is not None:
            times = sample_times(local.duration)
            check_motion_inside(self.workspace, (local.at(float(time)).pose.position for time in times))
        slowed, joints = self.kinematics.slow_to_feasible(local, self.now, self.limits, self.state)
        return ToolMotion(slowed, self.now, joints)

    def check_overlay(self, overlay: Overlay, axes: Array) -> None:
        """Raise Infeasible if a joint would be too fast for an overlay, or the tool would leave its workspace.

        axes (3, 3): along which it is, columns in the world.
        """
        in_base, place = self.base.rotation.T @ axes, self.state.tool.position
        self.kinematics.check_overlay_feasible(overlay, in_base, self.limits, self.state)
        if self.workspace is not None:
            for offset in sample_offsets(overlay):
                check_motion_inside(self.workspace, (place, place + in_base @ offset))
