"""Forward and inverse kinematics of an arm with the tool that it holds at present."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise

import mujoco
import numpy as np

from skillc_runtime.control.feasibility import check_overlay_feasible, slow_to_feasible
from skillc_runtime.control.inverse_kinematics import rank_arm_postures, solve_inverse_kinematics
from skillc_runtime.control.laws.virtual_arm import VirtualArm
from skillc_runtime.control.measured import NEAR_JOINT_RAD
from skillc_runtime.devices.arm import ArmLimits, ArmState
from skillc_runtime.motion.paths.joint_path import JointPath, joint_path
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Overlay, Trajectory

JOINT_RAMP_S = 0.5
"""Time in which a joint motion reaches its full speed."""

SPEED_SAMPLES, SPEED_MARGIN = 20, 0.85
"""Number of samples of a joint motion for the speed of its tool, and the share of the limit that is used."""


class Kinematics:
    """Kinematics in the arm's base frame; a measured state gives the tool centre point on the hand."""

    def __init__(self, virtual: mujoco.MjModel) -> None:
        self._virtual, self._arm = virtual, VirtualArm(virtual)

    def __reduce__(self) -> tuple[type[Kinematics], tuple[mujoco.MjModel]]:
        return Kinematics, (self._virtual,)

    def tool_at(self, q: Array, state: ArmState) -> tuple[Pose, Array]:
        """Return tool in base and Jacobian (6, nv), [linear m; angular rad] per rad, at joints q (nv,) in rad."""
        self._arm.hang_tool(state.q, state.tool)
        self._arm.update_kinematics(q)
        return self._arm.tool, self._arm.jacobian.copy()

    def tool_positions(self, postures: Iterable[Array], state: ArmState) -> list[Array]:
        """Return where the tool is in base, each (3,) in m, at postures (nv,) in rad."""
        self._arm.mount_tool(state.q, state.tool)
        positions = []
        for q in postures:
            self._arm.update_kinematics(q)
            positions.append(self._arm.tool.position)
        return positions

    def slow_to_feasible(
        self, trajectory: Trajectory, q: Array, limits: ArmLimits, state: ArmState
    ) -> tuple[Trajectory, list[Array]]:
        """Return a motion in base from joints q (nv,) in rad, slowed down if a joint would be too fast.

        Also return the joints (nv,) in rad at samples of it. Raises Infeasible if the arm cannot follow it.
        """
        self._arm.mount_tool(state.q, state.tool)
        return slow_to_feasible(self._arm, trajectory, q, limits)

    def check_overlay_feasible(self, overlay: Overlay, axes: Array, limits: ArmLimits, state: ArmState) -> None:
        """Raise Infeasible if a joint would be too fast for an overlay along `axes` (3, 3) in the present posture."""
        self._arm.mount_tool(state.q, state.tool)
        check_overlay_feasible(self._arm, overlay, axes, limits)

    def limit_tool_speed(self, start: Array, goal: Array, speed: Array, most_m_s: float, state: ArmState) -> Array:
        """Return joint speeds (nv,) in rad/s, all scaled down so that a joint motion keeps the tool below a speed.

        start: (nv,) in rad.
        goal: (nv,) in rad.
        speed: (nv,) in rad/s, of the joints.
        most_m_s: m/s, of the tool.
        """
        change, fastest = goal - start, 0.0
        way = np.maximum(np.abs(change), 1e-12)
        self._arm.mount_tool(state.q, state.tool)
        for share in np.linspace(0.0, 1.0, SPEED_SAMPLES):
            self._arm.update_kinematics(start + share * change)
            fastest = max(fastest, float(np.linalg.norm(self._arm.jacobian[:3] @ change)))
        return speed * min(1.0, SPEED_MARGIN * most_m_s / max(fastest * float((speed / way).min()), 1e-12))

    def joint_path(
        self, postures: Sequence[Array], limits: ArmLimits, share: float, most_m_s: float, blend: float, state: ArmState
    ) -> JointPath:
        """Return a joint motion through postures, which keeps the tool below a speed.

        postures: each (nv,) in rad.
        share: above 0 to 1, the share of the greatest joint speeds.
        most_m_s: m/s, of the tool.
        blend: 0 to 1, the share of the possible overlap at each intermediate posture; the motion stops there at 0.
        """
        calm = [self.limit_tool_speed(*piece, share * limits.velocity, most_m_s, state) for piece in pairwise(postures)]
        slowest = np.min(calm, axis=0)
        ramp = np.minimum(slowest / JOINT_RAMP_S, limits.acceleration)
        return joint_path(postures, slowest, ramp, [blend] * (len(postures) - 2))

    def tracking_error_message(self, wanted: Array, q: Array) -> str | None:
        """Return a message about the joint with the greatest error; None if all errors are small.

        wanted, q (nv,): rad.
        """
        far = np.abs(wanted - q)
        joint = int(far.argmax())
        if far[joint] <= NEAR_JOINT_RAD:
            return None
        unit = self._arm.joint_unit(joint)
        return f"{self._arm.joint_name(joint)} is {far[joint]:.3f} {unit} away from where it shall be"

    def inverse_kinematics(self, target: Pose, seed: Array, limits: Array, state: ArmState) -> Array | None:
        """Return joints (nv,) in rad, within limits, with the tool at the target, near the seed, or None.

        target: pose of the tool in the frame of the base.
        seed: (nv,) in rad.
        limits: (nv, 2) in rad, the ranges of the joints.
        """
        self._arm.mount_tool(state.q, state.tool)
        return solve_inverse_kinematics(self._arm, target, seed, limits)

    def rank_postures(self, target: Pose, rest: Array, limits: Array, state: ArmState) -> Array:
        """Return postures (n, nv) in rad, within limits, with the tool at the target, the best first.

        target: pose of the tool in the frame of the base.
        rest: (nv,) in rad, near which they are.
        limits: (nv, 2) in rad, the ranges of the joints.
        """
        self._arm.mount_tool(state.q, state.tool)
        return rank_arm_postures(self._arm, target, rest, limits)
