"""Motions of the tool or the joints of one arm, for skills."""

from __future__ import annotations

import numpy as np

from skillc_runtime.control.arm_task import ArmTask
from skillc_runtime.control.motion_model import ArmMotionModel
from skillc_runtime.devices.motion_interface import ToolMotion
from skillc_runtime.motion.paths.joint import JointTrajectory
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Overlay, Reference, Trajectory

NO_REFERENCE: Array = np.full((8, 3), np.nan)


class MotionControl:
    """Implements `MotionInterface` for an arm; joint motions keep the tool below a speed in m/s.

    A new motion starts where the one before it comes to rest, never at the measured pose.
    """

    def __init__(self, task: ArmTask, tool_speed_m_s: float) -> None:
        self._task, self._tool_speed_m_s = task, tool_speed_m_s

    @property
    def reference(self) -> Reference:
        """The reference of the tool in the world, of the last control period."""
        task = self._task
        if task.joints is None:
            return task.tool.reference.transform(task.base())
        reference = task.joints.sample(task.now)
        tool, jacobian = task.kinematics.tool_at(reference.q, task.measured.state)
        return Reference.of(tool, jacobian @ reference.dq, jacobian @ reference.ddq).transform(task.base())

    @property
    def live_reference(self) -> Array:
        """The rows (8, 3) of the tool's reference in base, not a copy; NaN while the joints are controlled."""
        task = self._task
        return task.tool.reference_generator.plan.rows if task.joints is None else NO_REFERENCE

    @property
    def live_rows(self) -> tuple[Array, Array]:
        """The rows (8, 3) of the tool's reference in base, and of its path; not copies.

        NaN while the joints are controlled.
        """
        plan = self._task.tool.reference_generator.plan
        return (plan.rows, plan.path) if self._task.joints is None else (NO_REFERENCE, NO_REFERENCE)

    def copy_tool_reference(self) -> bytes:
        """Return a copy of `live_reference` as float64."""
        return self.live_reference.tobytes()

    @property
    def path_velocity(self) -> Array:
        """The velocity (3,) in m/s of the tool in the world, of its reference without overlays.

        While joints are controlled it is that of their reference in the posture that was measured last.
        """
        task = self._task
        if task.joints is None:
            velocity = task.tool.reference_generator.path.twist[:3]
        else:
            velocity = task.measured.state.jacobian[:3] @ task.joints.sample(task.now).dq
        return task.base().rotation @ velocity

    @property
    def done(self) -> bool:
        """Whether the reference without overlays is at rest."""
        task = self._task
        return (task.joints or task.tool.reference_generator).done(task.now)

    @property
    def at_rest(self) -> bool:
        """Whether the reference is at rest and no overlay is left."""
        task = self._task
        return (task.joints or task.tool.reference_generator).at_rest(task.now)

    @property
    def stationary(self) -> bool:
        """Whether the reference stands still: its motion has ended and no overlay is left, or they are paused."""
        task = self._task
        return (task.joints or task.tool).stationary(task.now)

    @property
    def tracking_error_message(self) -> str | None:
        """A message about the error of the arm along stiff axes; None if it is small."""
        task = self._task
        if task.joints is not None:
            return task.kinematics.tracking_error_message(task.joints.sample(task.now).q, task.measured.state.q)
        return task.tool.tracking_error_message(task.measured.state, task.now)

    def stopping_pose(self) -> Pose:
        """Return the pose in the world where a new motion of the tool starts: where its reference rests if stopped now.

        Switches the arm to tool control.
        """
        tool = self._task.move_tool()
        return self._task.base() @ tool.reference_generator.stopping_pose(self._task.now)

    def stopping_joints(self) -> Array:
        """Return the joints (nv,) in rad where a new motion of the joints starts; nothing changes."""
        return (self._task.joints or self._task.stopping_joint_reference()).stopping_joints(self._task.now)

    def model(self) -> ArmMotionModel:
        """Return the motions that the arm can make from where it is now, to be computed without it."""
        task, (start, now) = self._task, self.joints_ahead()
        state, speed, base = task.measured.state, self._tool_speed_m_s, task.base()
        here = Pose(base.position.copy(), base.rotation.copy())
        return ArmMotionModel(task.kinematics, task.limits, task.workspace, state, here, start, now, speed)

    def joints_ahead(self) -> tuple[Array, Array]:
        """Return the joints (nv,) in rad where they come to rest, and those from where a motion of the tool goes on."""
        task = self._task
        return self.stopping_joints(), task.controllers.joints_now(task.measured.state)

    def move_along(self, trajectory: Trajectory) -> None:
        """Move the tool along a trajectory in the world, slowed down if a joint would be too fast.

        Raises ValueError if it does not start at `stopping_pose`, Infeasible if the arm cannot follow it.
        """
        self._task.move_tool()
        self.follow_tool(self.model().tool_motion(trajectory))

    def follow_tool(self, motion: ToolMotion) -> None:
        """Move the tool as the model has computed; ValueError if the motion does not start at `stopping_pose`."""
        task = self._task
        task.move_tool().reference_generator.follow(motion.in_base, task.now)

    def move_joints(self, goal: Array, share: float) -> None:
        """Move the joints to `goal` (nv,) in rad; `share` as for `joint_motion` of the model."""
        self.follow_joints(self.model().joint_motion((goal,), share))

    def follow_joints(self, motion: JointTrajectory) -> None:
        """Move the joints as the model has computed; ValueError if the motion does not start at `stopping_joints`."""
        task = self._task
        task.move_joints().follow(motion, task.now)

    def stop(self) -> None:
        """Come to rest within the acceleration limit; compliance, push and overlays are kept."""
        self._task.stop()

    def hold_position(self) -> None:
        """Come to rest and hold the tool from now on, with springs on a compliant arm."""
        self._task.move_tool().reference_generator.stop(self._task.now)

    def pause(self) -> None:
        """Slow down to a standstill along the motion."""
        (self._task.joints or self._task.tool.reference_generator).pause(self._task.now)

    def resume(self) -> None:
        """Continue after `pause`."""
        (self._task.joints or self._task.tool.reference_generator).resume(self._task.now)

    def add_overlay(self, overlay: Overlay, axes: Array, fade: float) -> int:
        """Add an overlay along `axes` (3, 3), columns in the world, to the motion of the tool; return its handle.

        It fades in for `fade` s. Raises Infeasible if a joint would be too fast, or the tool would leave its workspace.
        """
        self._task.move_tool()
        self.model().check_overlay(overlay, axes)
        return self.add_checked_overlay(overlay, axes, fade)

    def add_checked_overlay(self, overlay: Overlay, axes: Array, fade: float) -> int:
        """Add an overlay that the model has checked, as `add_overlay`; axes (3, 3): columns in the world, fade: s."""
        task, tool = self._task, self._task.move_tool()
        return tool.reference_generator.add(overlay, task.base().rotation.T @ axes, fade, task.now)

    def remove_overlay(self, handle: int) -> None:
        """Fade an overlay out."""
        self._task.tool.reference_generator.remove(handle, self._task.now)

    def inverse_kinematics(self, target: Pose, seed: Array) -> Array | None:
        """Return joints (nv,) in rad, within limits, with the tool at `target` in the world; None if there are none.

        The result is near `seed` (nv,).
        """
        return self.model().inverse_kinematics(target, seed)
