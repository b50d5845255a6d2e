"""Motions of an arm that another process controls: computed here, followed there."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from skillc_runtime.backends.control_process.remote.host import ControlProcess
from skillc_runtime.control.kinematics import Kinematics
from skillc_runtime.control.motion_model import ArmMotionModel
from skillc_runtime.control.supervision.safety import SafetyLimits
from skillc_runtime.devices.arm import ArmLimits
from skillc_runtime.devices.motion_interface import ToolMotion
from skillc_runtime.motion.paths.joint import JointTrajectory
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Overlay, Reference, Trajectory


class RemoteMotion:
    """Implements `MotionInterface`; joint motions keep the tool within the limits of `safety`."""

    def __init__(
        self,
        process: ControlProcess,
        base: Callable[[], Pose],
        kinematics: Kinematics,
        limits: ArmLimits,
        safety: SafetyLimits,
    ) -> None:
        self._process, self._base, self._kinematics = process, base, kinematics
        self._limits, self._safety = limits, safety

    @property
    def reference(self) -> Reference:
        """The reference of the tool in the world, of the last time when it was published."""
        return self._process.read().reference.transform(self._base())

    @property
    def path_velocity(self) -> Array:
        """The velocity (3,) in m/s of the tool in the world, of its reference without overlays."""
        return self._base().rotation @ self._process.read().field("path_velocity")

    @property
    def done(self) -> bool:
        """Whether the reference without overlays is at rest."""
        return self._process.read().holds("done")

    @property
    def stationary(self) -> bool:
        """Whether the reference stands still: its motion has ended and no overlay is left, or they are paused."""
        return self._process.read().holds("stationary")

    @property
    def tracking_error_message(self) -> str | None:
        """A message about the error of the arm along stiff axes; None if it is small."""
        message: str | None = self._call("tracking_error_message")
        return message

    def stopping_pose(self) -> Pose:
        """Return the pose in the world where a new motion of the tool starts; switches the arm to tool control."""
        in_base: Pose = self._call("stopping_pose")
        return self._base() @ in_base

    def stopping_joints(self) -> Array:
        """Return the joints (nv,) in rad where a new motion of the joints starts; nothing changes."""
        start, _ = self._call("joints_ahead")
        joints: Array = start
        return joints

    def model(self) -> ArmMotionModel:
        """Return the motions that the arm can make from where it is now, to be computed without it."""
        start, now = self._call("joints_ahead")
        state, safety = self._process.read().state, self._safety
        return ArmMotionModel(
            self._kinematics, self._limits, safety.workspace, state, self._base(), start, now, safety.tool_speed_m_s
        )

    def move_along(self, trajectory: Trajectory) -> None:
        """Move the tool along a trajectory in the world, slowed down if a joint would be too fast.

        Raises ValueError if it does not start at `stopping_pose`, Infeasible if the arm cannot follow it.
        """
        self._call("stopping_pose")
        self.follow_tool(self.model().tool_motion(trajectory))

    def follow_tool(self, motion: ToolMotion) -> None:
        """Move the tool as the model has computed; ValueError if the motion does not start at `stopping_pose`."""
        self._call("follow_tool", motion)

    def move_joints(self, goal: Array, share: float) -> None:
        """Move the joints to `goal` (nv,) in rad; `share` as for `joint_motion` of the model."""
        self.follow_joints(self.model().joint_motion((goal,), share))

    def follow_joints(self, motion: JointTrajectory) -> None:
        """Move the joints as the model has computed; ValueError if the motion does not start at `stopping_joints`."""
        self._call("follow_joints", motion)

    def stop(self) -> None:
        """Come to rest within the acceleration limit; compliance, push and overlays are kept."""
        self._call("stop")

    def hold_position(self) -> None:
        """Come to rest and hold the tool from now on, with springs on a compliant arm."""
        self._call("hold_position")

    def pause(self) -> None:
        """Slow down to a standstill along the motion."""
        self._call("pause")

    def resume(self) -> None:
        """Continue after `pause`."""
        self._call("resume")

    def add_overlay(self, overlay: Overlay, axes: Array, fade: float) -> int:
        """Add an overlay along `axes` (3, 3), columns in the world, which fades in for `fade` s; return its handle.

        Raises Infeasible if a joint would be too fast, or the tool would leave its workspace.
        """
        self._call("stopping_pose")
        self.model().check_overlay(overlay, axes)
        handle: int = self._call("add_checked_overlay", overlay, self._base().rotation.T @ axes, fade)
        return handle

    def remove_overlay(self, handle: int) -> None:
        """Fade an overlay out."""
        self._call("remove_overlay", handle)

    def inverse_kinematics(self, target: Pose, seed: Array) -> Array | None:
        """Return joints (nv,) in rad, near `seed`, with the tool at a pose in the world; None if there are none."""
        return self.model().inverse_kinematics(target, seed)

    def _call(self, name: str, *arguments: Any) -> Any:
        return self._process.call("motion", name, *arguments)
