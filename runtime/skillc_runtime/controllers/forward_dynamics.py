"""Forward-dynamics compliance for position-controlled arms that feel forces: a virtual arm moves, the real one follows.

w_C = -K sat(e) + W + W_ext;  a = A w_C / T + nu_d / T + a_d;  ddq = H^-1 J_C^T a
dq <- g dq + (1 - g) T ddq, g = exp(-h/T);  q <- q + h dq
Scherzinger, Roennau, Dillmann 2017; gains per second and feed-forward along stiff axes. C: compliance frame.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import exp

import mujoco
import numpy as np

from skillc_runtime.controllers.gains import Gains, Number
from skillc_runtime.controllers.joint_position import JointServo
from skillc_runtime.controllers.limits import JointLimit
from skillc_runtime.controllers.task_error import TaskError
from skillc_runtime.controllers.virtual_arm import VirtualArm
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Compliance, Reference
from skillc_runtime.robots.arm import ArmLimits, ArmState, JointPosition, Mode
from skillc_runtime.robots.laws import Laws


@dataclass(frozen=True, slots=True)
class ForwardDynamicsGains:
    """For a position-controlled arm with a force/torque sensor.

    admittance m/(s N), rotational_admittance rad/(s N m): steady tool velocity per wrench; admittance_time s: its lag.
    """

    admittance: float
    rotational_admittance: float
    admittance_time: float

    @property
    def mode(self) -> Mode:
        """Joint positions."""
        return "position"

    @property
    def needs_force(self) -> bool:
        """Yes: an arm that does not feel what it touches does not yield."""
        return True

    @property
    def release_damping(self) -> float:
        """Force per speed of a released axis, N s/m."""
        return 1 / self.admittance

    def laws(self, gains: Gains, limits: ArmLimits, virtual: mujoco.MjModel, state: ArmState, period: float) -> Laws:
        """Make the laws of one arm."""
        limit = JointLimit(limits, state.q)
        return Laws(ForwardDynamics(gains, self, limit, VirtualArm(virtual)), JointServo(limit), limit)


def from_sheet(number: Number) -> ForwardDynamicsGains:
    """Read the gains from an arm's data sheet."""
    return ForwardDynamicsGains(number("admittance"), number("rotationalAdmittance"), number("admittanceTime"))


class ForwardDynamics:
    """The law for one arm. It integrates from the last command, never from the measurement. Arrays are reused."""

    def __init__(self, gains: Gains, law: ForwardDynamicsGains, limit: JointLimit, arm: VirtualArm) -> None:
        self._limit, self._arm = limit, arm
        self._task = TaskError(np.repeat([gains.linear_stiffness, gains.rotational_stiffness], 3))
        self._rate = np.repeat([law.admittance, law.rotational_admittance], 3) / law.admittance_time
        self._lag = law.admittance_time
        self._wrench, self._part, self._in_base, self._felt = (np.zeros(6) for _ in range(4))
        self._wrench_halves, self._base_halves = self._wrench.reshape(2, 3), self._in_base.reshape(2, 3)
        self._dq, self._ddq, self._torque, self._q = (np.zeros(arm.joints) for _ in range(4))

    @property
    def tool(self) -> Pose:
        """Where the commanded joints put the tool centre point, in base; a copy."""
        return self._arm.tool

    @property
    def contact_wrench(self) -> Array:
        """The measured wrench (6,)."""
        return self._felt.copy()

    def reset(self, state: ArmState, q: Array) -> None:
        """Start from rest at q."""
        self._arm.mount(state.q, state.tool)
        self._arm.move(q)
        self._dq[:] = 0.0

    def command(self, state: ArmState, reference: Reference, compliance: Compliance, period: float) -> JointPosition:
        """Return the joint positions."""
        self._felt[:] = state.wrench
        self._arm.move(self._limit.q)
        self._arm.weigh()
        self._task.update(self._arm.live_tool, reference, compliance, self._felt)
        self._accelerate(compliance)
        keep = exp(-period / self._lag)
        self._dq *= keep
        self._ddq *= (1 - keep) * self._lag
        self._dq += self._ddq
        self._limit.slowed(self._dq)
        np.multiply(self._dq, period, out=self._q)
        self._q += self._limit.q
        return JointPosition(self._limit.step(self._q, state, period))

    def _accelerate(self, compliance: Compliance) -> None:
        """Compute the virtual joint accelerations ddq (nv,)."""
        task = self._task
        np.add(task.measured, compliance.wrench, out=self._wrench)
        np.multiply(compliance.stiffness, task.error, out=self._part)
        self._wrench -= self._part
        self._wrench *= self._rate
        np.divide(task.twist, self._lag, out=self._part)
        self._wrench += self._part
        self._wrench += task.acceleration
        np.dot(self._wrench_halves, task.axes.T, out=self._base_halves)
        np.dot(self._in_base, self._arm.jacobian, out=self._torque)
        mujoco.mju_cholFactor(self._arm.inertia, 0.0)
        mujoco.mju_cholSolve(self._ddq, self._arm.inertia, self._torque)
