"""Cartesian impedance for torque-controlled arms: springs and dampers hold the tool, and it pushes open loop.

F_C = -K sat(e) - D (J_C dq - nu_d) - B over(J_C dq) + W + Lam_C a_d;  tau = J_C^T F_C + tau_null + bias
B brakes speed beyond the limit of the compliance.
The power of the first term of tau is limited to that of skills: force limit times speed limit.
Albu-Schaeffer et al. 2003, Mayr and Salt-Ducaju 2022; with velocity and acceleration feed-forward. C: compliance frame.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

import numpy as np

from skillc_runtime.control.damping import BRAKE_RATE, tool_inertia
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
    clamp_length,
    compute_task_error,
    make_task_error,
    speed_excess,
)
from skillc_runtime.devices.arm import ArmState, Torque
from skillc_runtime.motion.arrays import OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import times, transposed_times
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Compliance, Reference

INERTIA_PERIOD_S = 0.01
"""Period with which inertia and damping, which change slowly, are computed."""

FASTEST_DECAY = 1.5
"""Greatest decay rate of damping, times the control period: from 2 on it is unstable."""


@dataclass(frozen=True, slots=True)
class ImpedanceMemory:
    """Parameters and state of the law of one arm, kept between control periods; C is the compliance frame.

    task: errors and forces along C; tool (4, 3): the measured tool centre point in base, position in m, then rotation;
    limits (5, nv): see `TorqueLimit`. inertia (6, 6): of the tool along C, kg and kg m^2; floor (6,): least damping,
    N s/m and N m s/rad. rest (nv,): rad, posture to which a redundant arm is pulled with rest_stiffness N m/rad.
    torque_rate N m/s: greatest change of a joint torque; force_n N, power_w W: limits of springs, dampers and brakes.
    """

    task: TaskError
    tool: OutMatrix
    limits: OutMatrix
    inertia: OutMatrix
    floor: Vector
    rest: OutVector
    rest_stiffness: float
    torque_rate: float
    force_n: float
    power_w: float


class Impedance:
    """The law for one arm; the reference is in the base frame. Arrays are reused."""

    def __init__(self, gains: Gains, law: ImpedanceGains, limit: TorqueLimit, joints: int) -> None:
        stiffness = np.repeat([gains.linear_stiffness, gains.rotational_stiffness], 3)
        self._posture = Nullspace(law.nullspace_stiffness, joints)
        self._memory = ImpedanceMemory(
            task=make_task_error(stiffness),
            tool=np.zeros((4, 3)),
            limits=limit.rows,
            inertia=np.zeros((6, 6)),
            floor=np.repeat([law.damping_floor, law.rotational_damping_floor], 3),
            rest=self._posture.rest,
            rest_stiffness=self._posture.stiffness,
            torque_rate=limit.rate,
            force_n=gains.limits.force_n,
            power_w=gains.limits.force_n * gains.limits.speed_m_s,
        )
        self._damping = Lag(self._memory.floor, gains.command_time)
        self._age = INERTIA_PERIOD_S

    @property
    def tool(self) -> Pose:
        """The measured tool centre point in base; its arrays change with every command."""
        return Pose(self._memory.tool[0], self._memory.tool[1:])

    @property
    def contact_wrench(self) -> Array:
        """An estimate (6,) in N and N m, base axes: the negative wrench of springs, dampers and push.

        It is exact at constant speed.
        """
        exerted: Array = self._memory.task.rows[EXERTED]
        return (exerted.reshape(2, 3) @ -self._memory.task.axes.T).ravel()

    def reset(self, state: ArmState, q: Array, dq: Array) -> None:
        """Start with `q` (nv,) in rad as the rest posture; dq (nv,) in rad/s is not used."""
        self._memory.tool[0], self._memory.tool[1:] = state.tool.position, state.tool.rotation
        self._age = INERTIA_PERIOD_S
        self._damping.value[:] = self._memory.floor
        self._memory.rest[:] = q

    def command(self, state: ArmState, reference: Reference, compliance: Compliance, period: float) -> Torque:
        """Return the joint torques (nv,) in N m for the next `period` s."""
        self._update_damping(state, reference, compliance, period)
        tau, posture = np.empty_like(state.q), self._posture
        posture.manipulability = impedance_torque(
            tau, self._memory, state, reference, compliance, posture.manipulability, period
        )
        return Torque(tau)

    def _update_damping(self, state: ArmState, reference: Reference, compliance: Compliance, period: float) -> None:
        """Update inertia and damping if due; the damping follows with the command time."""
        self._age += period
        if self._age < INERTIA_PERIOD_S:
            return
        damping, rows = np.empty(6), self._memory.task.rows
        design_damping(damping, self._memory, state, reference, compliance, FASTEST_DECAY / period)
        rows[DAMPING] = self._damping.step(damping, self._age)
        self._age = 0.0


@compiled
def design_damping(
    damping: OutVector,
    memory: ImpedanceMemory,
    state: ArmState,
    reference: Reference,
    compliance: Compliance,
    fastest: float,
) -> None:
    """Lam_C = (J_C M^-1 J_C^T)^-1; D_i = 2 zeta sqrt(K_i Lam_C,ii), at least the floor; B_i = rate / (Lam_C^-1)_ii.

    damping (6,): D in N s/m and N m s/rad, along the axes of C. It is reduced where an upper bound of the eigenvalues
    of Lam_C^-1 D exceeds `fastest` in 1/s.
    """
    mobility, added, square = np.empty((6, 6)), np.empty(6), 0.0
    inertia, floor, braking = memory.inertia, memory.floor, memory.task.rows[BRAKING]
    tool_inertia(inertia, mobility, state.jacobian, state.mass_matrix, reference.rows[1:4], compliance.frame)
    for i in range(6):
        wanted = 2 * compliance.damping_ratio * sqrt(compliance.stiffness[i] * inertia[i, i])
        added[i] = max(wanted - floor[i], 0.0)
    for i in range(6):
        decay = 0.0
        for j in range(6):
            decay += mobility[i, j] * mobility[i, j] * (floor[j] + added[j])
        square += (floor[i] + added[i]) * decay
    share = min(1.0, fastest / sqrt(square))
    for i in range(6):
        damping[i] = floor[i] + share * added[i]
        braking[i] = BRAKE_RATE / mobility[i, i]


@inlined
def tool_torque(tau: Array, memory: ImpedanceMemory, state: ArmState, compliance: Compliance) -> None:
    """exerted (6,) = W - K sat(e) - D (J_C dq - nu_d) - B over, along C; tau (nv,) = J_C^T (exerted + Lam_C a_d).

    exerted: N and N m; tau: N m. The force of springs, dampers and brakes is limited to `force_n`, and all torques are
    scaled down if their power exceeds `power_w`.
    """
    rows, axes = memory.task.rows, memory.task.axes
    exerted, force, in_base = rows[EXERTED], np.empty(6), np.empty(6)
    for i in range(6):
        spring = -compliance.stiffness[i] * rows[ERROR, i]
        exerted[i] = spring - rows[DAMPING, i] * (rows[MEASURED, i] - rows[TWIST, i])
    for i in range(3):
        exerted[i] -= rows[BRAKING, i] * speed_excess(rows[MEASURED, i], compliance.fastest[i])
    clamp_length(exerted[:3], memory.force_n)
    times(memory.inertia, rows[ACCELERATION], force)
    for i in range(6):
        exerted[i] += compliance.wrench[i]
        force[i] += exerted[i]
    times(axes, force[:3], in_base[:3])
    times(axes, force[3:], in_base[3:])
    transposed_times(state.jacobian, in_base, tau)
    power = 0.0
    for j in range(tau.size):
        power += tau[j] * state.dq[j]
    if power > memory.power_w:
        tau *= memory.power_w / power


@compiled
def impedance_torque(
    tau_out: OutVector,
    memory: ImpedanceMemory,
    state: ArmState,
    reference: Reference,
    compliance: Compliance,
    manipulability: float,
    period: float,
) -> float:
    """Compute the torques tau_out (nv,) in N m for the next `period` s; store tool and errors in the memory.

    manipulability: of the period before. Return that of this one, which an arm with more than six joints uses to keep
    its posture. The reference is in the base frame.
    """
    for i in range(3):
        memory.tool[0, i] = state.tool.position[i]
        for j in range(3):
            memory.tool[1 + i, j] = state.tool.rotation[i, j]
    q, dq, J = state.q, state.dq, state.jacobian
    tau, velocity = np.empty(q.size), np.empty(6)
    times(J, dq, velocity)
    compute_task_error(memory.task, state.tool, reference, compliance, velocity)
    tool_torque(tau, memory, state, compliance)
    if q.size > 6:
        posture = np.empty(q.size)
        manipulability = posture_torque(posture, q, dq, J, memory.rest, memory.rest_stiffness, manipulability)
        tau += posture
    limit_torque(tau_out, memory.limits, tau, q, state.bias, memory.torque_rate * period)
    return manipulability
