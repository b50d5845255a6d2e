"""An arm without physics: its joints follow its servos or torques, and what touches its tool."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.simulation.arms.arm import ModelledArm
from skillc_runtime.backends.simulation.arms.motors import ServoGains, Servos
from skillc_runtime.backends.simulation.arms.sensing import TOOL
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.devices.arm import ArmLimits, ArmState
from skillc_runtime.motion.arrays import Matrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled
from skillc_runtime.motion.numerics.linear import cholesky, cholesky_solve, cross, times, transposed_times
from skillc_runtime.motion.pose import Array, Pose

WRIST = 3
"""The first row of `LastLink` with the axes of the wrist."""


class KinematicArm(ModelledArm):
    """One arm of a kinematic cell; what touches its tool, or is applied to its hand in `data`, pushes it."""

    measures_effort = False

    def __init__(
        self, facts: ArmSpec, names: Mapping[str, str], model: Any, data: Any, start: Array, steps: int
    ) -> None:
        """Place the joints at `start` (nv,) in rad; commands arrive every `steps` steps."""
        super().__init__(facts, names, model, data, start, steps)
        if self._feels_force:
            self._gain[:, :6] = np.eye(6)
        self._wrench, self._measured_at, self._twist = np.zeros(6), -1.0, data.cvel[self._link]
        gripper = self._gripper_name
        self._palm = self._link if gripper is None else int(model.body(part_name(gripper, "palm")).id)

    @property
    def links(self) -> tuple[int, int]:
        """The bodies of the last link and of its root."""
        return self._link, int(self._model.body_rootid[self._link])

    @property
    def motion(self) -> tuple[Array, Array]:
        """The twist (6,) of the last link, [angular rad/s; linear m/s], and where it holds (3,) m; in the world."""
        return self._twist, self._sensing.centre

    def state(self) -> ArmState:
        """Return the present state, in the arm's base frame."""
        self._measured_at = self._data.time
        return super().state()

    @property
    def measuring(self) -> None:
        """None: Python measures."""

    def tool_point(self) -> Array:
        """Return the tool centre point (3,) in m in the world."""
        live = self._sensing.link
        point: Array = live.rotation @ self._hand.on_link[TOOL] + live.position
        return point

    def feel(self, contact: Array) -> None:
        """Let a wrench of contacts (6,) at the tool, N and N m in the world, act, and what is applied to the hand."""
        data, palm, sensing = self._data, self._palm, self._sensing
        applied, centre = data.xfrc_applied[palm], data.xipos[palm]
        add_wrenches(
            self._wrench, self._readings, contact, applied, centre, sensing.link, sensing.on_link, sensing.base.rotation
        )

    def step(self, period_s: float) -> None:
        """Move the joints for one step as the motors and the wrench on the tool want."""
        if self._measured_at != self._data.time:
            self.state()
        here, motors, limits = self._here, self._motors, self.limits
        target, J = motors.joints.control, here.jacobian
        if isinstance(motors, Servos):
            follow_servos(self._q, self._dq, target, motors.gains, limits, J, self._wrench, period_s)
        else:
            follow_torques(self._q, self._dq, target, here.mass_matrix, limits, J, self._wrench, period_s)

    def _update_mass_matrix(self) -> None:
        mujoco.mj_crb(self._model, self._data)
        super()._update_mass_matrix()


@compiled
def add_wrenches(
    in_base: OutVector,
    readings: OutVector,
    contact: Vector,
    applied: Vector,
    centre: Vector,
    link: Pose,
    on_link: Matrix,
    base_rotation: Matrix,
) -> None:
    """Compute in_base (6,), N and N m at the tool centre point in base axes, and readings (9,), the same in wrist axes.

    In the world: contact (6,) at the tool centre point; applied (6,) at centre (3,) m; link: the last link;
    base_rotation (3, 3). on_link (8, 3): see `LastLink`.
    """
    lever, moment, in_link = np.empty(3), np.empty(3), np.empty((2, 3))
    times(link.rotation, on_link[TOOL], lever)
    for i in range(3):
        lever[i] = centre[i] - link.position[i] - lever[i]
    cross(lever, applied[:3], moment)
    for i in range(3):
        lever[i] = contact[i] + applied[i]
        moment[i] += contact[3 + i] + applied[3 + i]
    transposed_times(base_rotation, lever, in_base[:3])
    transposed_times(base_rotation, moment, in_base[3:])
    transposed_times(link.rotation, lever, in_link[0])
    transposed_times(link.rotation, moment, in_link[1])
    times(on_link[WRIST : WRIST + 3], in_link[0], readings[:3])
    times(on_link[WRIST : WRIST + 3], in_link[1], readings[3:6])


@compiled
def follow_servos(
    q: OutVector,
    dq: OutVector,
    target: Vector,
    gains: ServoGains,
    limits: ArmLimits,
    J: Matrix,
    wrench: Vector,
    period: float,
) -> None:
    """dq = (kp (target - q) + J^T w) / kv: servos without inertia; q (nv,) rad and dq rad/s change.

    target (nv,): rad; gains: kp N m/rad, kv N m s/rad; J (6, nv) and w (6,), N and N m, in base axes; period: s.
    """
    pushed = np.empty(q.size)
    transposed_times(J, wrench, pushed)
    for j in range(q.size):
        wanted = (gains.stiffness[j] * (target[j] - q[j]) + pushed[j]) / gains.damping[j]
        speed = min(max(wanted, -limits.velocity[j]), limits.velocity[j])
        after = min(max(q[j] + period * speed, limits.range[j, 0]), limits.range[j, 1])
        dq[j] = (after - q[j]) / period
        q[j] = after


@compiled
def follow_torques(
    q: OutVector,
    dq: OutVector,
    tau: Vector,
    mass: Matrix,
    limits: ArmLimits,
    J: Matrix,
    wrench: Vector,
    period: float,
) -> None:
    """M ddq = tau + J^T w, without weight and Coriolis forces; q (nv,) in rad and dq in rad/s change.

    tau (nv,): N m; mass (nv, nv): M, kg m^2; the others as for `follow_servos`.
    """
    factor, pushed, ddq = np.empty((q.size, q.size)), np.empty(q.size), np.empty(q.size)
    transposed_times(J, wrench, pushed)
    for j in range(q.size):
        pushed[j] += tau[j]
        for k in range(q.size):
            factor[j, k] = mass[j, k]
    cholesky(factor)
    cholesky_solve(factor, pushed, ddq)
    for j in range(q.size):
        speed = min(max(dq[j] + period * ddq[j], -limits.velocity[j]), limits.velocity[j])
        after = min(max(q[j] + period * speed, limits.range[j, 0]), limits.range[j, 1])
        dq[j] = (after - q[j]) / period
        q[j] = after
