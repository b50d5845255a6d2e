"""Cartesian impedance for torque-controlled arms: the tool is held by springs and dampers, and pushes open loop.

F_C = -K sat(e) - D (J_C dq - nu_d) - B over(J_C dq) + W + Lam_C a_d;  tau = J_C^T F_C + tau_null + bias
B brakes what is over the speed with which a tool may yield.
The first term of tau moves the arm with no more power than skills may ask for: force limit times speed limit.
Albu-Schaeffer et al. 2003, Mayr and Salt-Ducaju 2022; with velocity and acceleration feed-forward. C: compliance frame.
"""

from __future__ import annotations

import numpy as np

from skillc_runtime.control.damping import design_damping
from skillc_runtime.control.filters import Lag
from skillc_runtime.control.gains import Gains, ImpedanceGains
from skillc_runtime.control.limits import TorqueLimit, limit_torque
from skillc_runtime.control.nullspace import Nullspace, posture_torque
from skillc_runtime.control.task_error import (
    ACCELERATION,
    BRAKING,
    DAMPING,
    ERROR,
    EXERTED,
    MEASURED,
    TWIST,
    TaskError,
    over,
    shorten,
    task_error,
)
from skillc_runtime.devices.arm import ArmState, Torque
from skillc_runtime.motion.numerics.compiled import Matrix, OutMatrix, OutVector, Vector, compiled, part
from skillc_runtime.motion.numerics.linear import times, transposed_times
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Compliance, Reference

INERTIA_PERIOD_S = 0.01
"""Inertia and damping change slowly; they are computed this often."""

FASTEST_DECAY = 1.5
"""Share of a control period's inverse that dampers may decay with: from 2 on they overshoot, the more the longer."""


class Impedance:
    """The law for one arm. All arrays are made once and reused."""

    def __init__(self, gains: Gains, law: ImpedanceGains, limit: TorqueLimit, joints: int) -> None:
        self._limit = limit
        self._force_n = gains.limits.force_n
        self._power_w = gains.limits.force_n * gains.limits.speed_m_s
        self._floor = np.repeat([law.damping_floor, law.rotational_damping_floor], 3)
        self._task = TaskError(np.repeat([gains.linear_stiffness, gains.rotational_stiffness], 3))
        self._damping = Lag(self._floor, gains.command_time)
        self._posture = Nullspace(law.nullspace_stiffness, joints)
        self._age, self._inertia, self._seen = INERTIA_PERIOD_S, np.zeros((6, 6)), np.zeros((4, 3))

    @property
    def tool(self) -> Pose:
        """The measured tool centre point in base, changing with every command."""
        return Pose(self._seen[0], self._seen[1:])

    @property
    def contact_wrench(self) -> Array:
        """An estimate (6,): the opposite of what springs, dampers and push exert; exact at constant speed."""
        exerted: Array = self._task.rows[EXERTED]
        return (exerted.reshape(2, 3) @ -self._task.axes.T).ravel()

    def reset(self, state: ArmState, q: Array, dq: Array) -> None:
        """Start; `q` becomes the rest posture."""
        self._seen[0], self._seen[1:] = state.tool.position, state.tool.rotation
        self._age = INERTIA_PERIOD_S
        self._damping.value[:] = self._floor
        self._posture.rest[:] = q

    def command(self, state: ArmState, reference: Reference, compliance: Compliance, period: float) -> Torque:
        """Return the joint torques."""
        self._renew(state, reference, compliance, period)
        told, task, posture, limit = np.empty_like(state.q), self._task, self._posture, self._limit
        posture.manipulability = impedance_torque(
            told, task.rows, task.axes, self._seen, limit.rows,
            state.q, state.dq, state.bias, state.jacobian, state.tool.position, state.tool.rotation, reference.rows,
            compliance.stiffness, compliance.wrench, compliance.frame, compliance.fastest,
            self._inertia, self._force_n, self._power_w,
            posture.rest, posture.stiffness, posture.damping, posture.regularisation, limit.rate * period,
        )  # fmt: skip
        return Torque(told)

    def _renew(self, state: ArmState, reference: Reference, compliance: Compliance, period: float) -> None:
        """Renew inertia and damping every so often; the damping follows with the command time."""
        self._age += period
        if self._age < INERTIA_PERIOD_S:
            return
        wanted, fastest = np.empty(6), FASTEST_DECAY / period
        design_damping(
            wanted, self._task.rows[BRAKING], self._inertia,
            state.jacobian, state.mass_matrix, reference.pose.rotation, compliance.frame, compliance.stiffness,
            self._floor, compliance.damping_ratio, fastest,
        )  # fmt: skip
        self._task.rows[DAMPING] = self._damping.step(wanted, self._age)
        self._age = 0.0


@part
def tool_torque(
    tau: Array,
    rows: Array,
    axes: Array,
    J: Array,
    dq: Array,
    stiffness: Array,
    wrench: Array,
    fastest: Array,
    inertia: Array,
    force_n: float,
    power_w: float,
) -> None:
    """exerted (6,) = W - K sat(e) - D (J_C dq - nu_d) - B over, along C; tau (nv,) = J_C^T (exerted + Lam_C a_d).

    The force of springs, dampers and brakes is at most `force_n`. Torques that would move the arm with more than
    `power_w` are scaled down as a whole.
    """
    exerted, force, in_base = rows[EXERTED], np.empty(6), np.empty(6)
    for i in range(6):
        exerted[i] = -stiffness[i] * rows[ERROR, i] - rows[DAMPING, i] * (rows[MEASURED, i] - rows[TWIST, i])
    for i in range(3):
        exerted[i] -= rows[BRAKING, i] * over(rows[MEASURED, i], fastest[i])
    shorten(exerted[:3], force_n)
    times(inertia, rows[ACCELERATION], force)
    for i in range(6):
        exerted[i] += wrench[i]
        force[i] += exerted[i]
    times(axes, force[:3], in_base[:3])
    times(axes, force[3:], in_base[3:])
    transposed_times(J, in_base, tau)
    power = 0.0
    for j in range(tau.size):
        power += tau[j] * dq[j]
    if power > power_w:
        tau *= power_w / power


@compiled
def impedance_torque(
    told: OutVector,
    rows: OutMatrix,
    axes: OutMatrix,
    seen: OutMatrix,
    limits: OutMatrix,
    q: Vector,
    dq: Vector,
    bias: Vector,
    J: Matrix,
    tool_position: Vector,
    tool_rotation: Matrix,
    reference: Matrix,
    stiffness: Vector,
    wrench: Vector,
    frame: Matrix,
    fastest: Vector,
    inertia: Matrix,
    force_n: float,
    power_w: float,
    rest: Vector,
    rest_stiffness: float,
    rest_damping: float,
    lam_square: float,
    longest: float,
) -> float:
    """Compute the whole law, told (nv,); keep the tool (4, 3) in `seen`, what is exerted in `rows`.

    Return the manipulability, which only an arm with more than six joints has use for: they have a posture to keep.
    """
    for i in range(3):
        seen[0, i] = tool_position[i]
        for j in range(3):
            seen[1 + i, j] = tool_rotation[i, j]
    tau, velocity, manipulability = np.empty(q.size), np.empty(6), np.inf
    times(J, dq, velocity)
    task_error(rows, axes, tool_position, tool_rotation, reference, stiffness, frame, velocity)
    tool_torque(tau, rows, axes, J, dq, stiffness, wrench, fastest, inertia, force_n, power_w)
    if q.size > 6:
        keeping = np.empty(q.size)
        manipulability = posture_torque(keeping, q, dq, J, rest, rest_stiffness, rest_damping, lam_square)
        tau += keeping
    limit_torque(told, limits, tau, q, bias, longest)
    return manipulability
