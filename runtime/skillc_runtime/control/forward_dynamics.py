"""Forward-dynamics compliance for arms that take positions and feel forces: a virtual arm moves, the real one follows.

w_C = -K sat(e) + W + W_ext;  a = A w_C / T + nu_d / T + a_d;  ddq = H^-1 (J_C^T a - c)
dq <- g dq + (1 - g) T ddq, g = exp(-h/T);  q <- q + h dq
Scherzinger, Roennau, Dillmann 2017; gains per second, Coriolis forces c, feed-forward along stiff axes. C: compliance
frame. Of what would be over the speed with which a tool may yield little is left.
"""

from __future__ import annotations

from math import exp

import numpy as np

from skillc_runtime.control.gains import ForwardDynamicsGains, Gains
from skillc_runtime.control.limits import FASTEST, TOLD, JointLimit, limit_joints
from skillc_runtime.control.task_error import ACCELERATION, ERROR, MEASURED, TWIST, TaskError, over, task_error
from skillc_runtime.control.virtual_arm import VirtualArm
from skillc_runtime.devices.arm import ArmState, Command
from skillc_runtime.motion.numerics.compiled import Matrix, OutMatrix, OutVector, Vector, compiled
from skillc_runtime.motion.numerics.linear import cholesky, cholesky_solve, times, transposed_times
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Compliance, Reference

BRAKED = 0.9
"""Share of what would be over the greatest speed with which a tool may yield that is taken off."""


class ForwardDynamics:
    """The law for one arm. It integrates from the last command, never from the measurement. Arrays are reused."""

    def __init__(self, gains: Gains, law: ForwardDynamicsGains, limit: JointLimit, arm: VirtualArm) -> None:
        self._limit, self._arm = limit, arm
        self._task = TaskError(np.repeat([gains.linear_stiffness, gains.rotational_stiffness], 3))
        self._rate = np.repeat([law.admittance, law.rotational_admittance], 3) / law.admittance_time
        self._lag = law.admittance_time
        self._felt = np.zeros(6)
        self._dq = np.zeros(arm.joints)

    @property
    def tool(self) -> Pose:
        """Where the commanded joints put the tool centre point, in base; a copy."""
        return self._arm.tool

    @property
    def contact_wrench(self) -> Array:
        """The measured wrench (6,)."""
        return self._felt.copy()

    def reset(self, state: ArmState, q: Array, dq: Array) -> None:
        """Start from q and dq."""
        self._arm.mount(state.q, state.tool)
        self._arm.move(q)
        self._dq[:] = dq

    def command(self, state: ArmState, reference: Reference, compliance: Compliance, period: float) -> Command:
        """Return where the joints shall be, or how fast, as the limit tells it."""
        self._felt[:] = state.wrench
        arm, task, limit = self._arm, self._task, self._limit
        tool = arm.live_tool
        arm.move(limit.q)
        arm.weigh(self._dq)
        followed = virtual_motion(
            self._dq, task.rows, task.axes, limit.rows,
            tool.position, tool.rotation, arm.jacobian, arm.inertia, arm.bias, state.q,
            reference.rows, compliance.stiffness, compliance.wrench, compliance.frame, compliance.fastest,
            self._felt, self._rate, self._lag, period,
        )  # fmt: skip
        return limit.followed(followed, state)


@compiled
def virtual_motion(
    dq: OutVector,
    rows: OutMatrix,
    axes: OutMatrix,
    limits: OutMatrix,
    tool_position: Vector,
    tool_rotation: Matrix,
    J: Matrix,
    inertia: OutMatrix,
    bias: Vector,
    measured: Vector,
    reference: Matrix,
    stiffness: Vector,
    wrench: Vector,
    frame: Matrix,
    fastest: Vector,
    felt: Vector,
    rate: Vector,
    lag: float,
    period: float,
) -> bool:
    """Compute dq (nv,), slowed down as a whole where a joint would be too fast, and what is told. rate (6,): A / T.

    Return False when the arm, whose joints are `measured`, does not follow.
    """
    task_error(rows, axes, tool_position, tool_rotation, reference, stiffness, frame, felt)
    push, in_base, torque, ddq = np.empty(6), np.empty(6), np.empty(dq.size), np.empty(dq.size)
    for i in range(6):
        pushed = rate[i] * (rows[MEASURED, i] + wrench[i] - stiffness[i] * rows[ERROR, i])
        push[i] = pushed + rows[TWIST, i] / lag + rows[ACCELERATION, i]
    for i in range(3):
        push[i] -= BRAKED * over(lag * push[i], fastest[i]) / lag
    times(axes, push[:3], in_base[:3])
    times(axes, push[3:], in_base[3:])
    transposed_times(J, in_base, torque)
    for j in range(dq.size):
        torque[j] -= bias[j]
    cholesky(inertia)
    cholesky_solve(inertia, torque, ddq)
    keep, excess, wanted = exp(-period / lag), 1.0, torque
    for j in range(dq.size):
        dq[j] = keep * dq[j] + (1 - keep) * lag * ddq[j]
        excess = max(excess, abs(dq[j] / limits[FASTEST, j]))
    for j in range(dq.size):
        dq[j] /= excess
        wanted[j] = limits[TOLD, j] + period * dq[j]
    return limit_joints(limits, wanted, measured, period)
