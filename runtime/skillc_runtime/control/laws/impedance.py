"""Cartesian impedance for torque-controlled arms: springs and dampers hold the tool, and it pushes open loop.

F_C = -K sat(e) - D (J_C dq - nu_d) - B over(J_C dq) + W + Lam_C a_d;  tau = J_C^T F_C + tau_null + bias
B brakes speed beyond the limit of the compliance. Where commands act d s late, a spring takes K d off its damping, to
first order: F(t - d) = -K (x - d dx/dt) - D dx/dt. So K <= DELAYED_SHARE D / d. As z^2 + (r d z + K d^2 / m) e^-z = 0,
z = s d, with r d = 0.6, DELAYED_DECAY, has an imaginary root at K d^2 / m = 0.46, K <= DELAYED_SPRING m / d^2.
The power of the first term of tau is limited to that of skills: force limit times speed limit.
Albu-Schaeffer et al. 2003, Mayr and Salt-Ducaju 2022; with velocity and acceleration feed-forward. C: compliance frame.
"""

from __future__ import annotations

from math import sqrt

import msgspec
import numpy as np

from skillc_runtime.control.filters import lag_share, step_lag
from skillc_runtime.control.gains import Gains, ImpedanceGains
from skillc_runtime.control.laws.damping import BRAKE_RATE, tool_inertia
from skillc_runtime.control.laws.nullspace import posture_torque
from skillc_runtime.control.laws.task_error import (
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
from skillc_runtime.control.limits import TorqueLimit, limit_torque
from skillc_runtime.devices.arm import ArmState, Torque
from skillc_runtime.motion.arrays import OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled_when_called, inlined
from skillc_runtime.motion.numerics.linear import copy_matrix, copy_vector, times, transposed_times
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import AppliedCompliance, Compliance, Reference, SampledReference

INERTIA_PERIOD_S = 0.01
"""Period with which inertia and damping, which change slowly, are computed."""

DELAYED_DECAY = 0.6
"""Greatest decay rate of damping, times the delay of commands: from pi / 2 on it is unstable."""

DELAYED_SHARE, DELAYED_SPRING = 0.6, 0.2
"""The share of its damping that delay may take off a spring, and the greatest K d^2 / m: from 1 and 0.46 on it is
unstable."""

DAMPING_GRAIN = 1e-6
"""Closer to its design than this, N s/m and N m s/rad, the damping has arrived."""

FASTEST_DECAY = 1.5
"""Greatest decay rate of damping, times the control period: from 2 on it is unstable."""


class ImpedanceMemory(msgspec.Struct, frozen=True):
    """Parameters and state of the law of one arm, kept between control periods; C is the compliance frame.

    task: errors and forces along C; tool (4, 3): the measured tool centre point in base, position in m, then rotation;
    limits (5, nv): see `TorqueLimit`. inertia (6, 6): of the tool along C, kg and kg m^2; floor (6,): least damping,
    N s/m and N m s/rad. rest (nv,): rad, posture to which a redundant arm is pulled with rest_stiffness N m/rad.
    torque_rate N m/s: greatest change of a joint torque; force_n N, power_w W: limits of springs, dampers and brakes.
    damping (6,): N s/m and N m s/rad, follows its design with command_time s; stiffest (6,): N/m and N m/rad, which the
    delay_s of commands leaves stable with that. age (1,): s since that was computed.
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
    damping: OutVector
    command_time: float
    age: OutVector
    delay_s: float
    stiffest: OutVector


class Impedance:
    """The law for one arm; the reference is in the base frame. Arrays are reused."""

    def __init__(
        self, gains: Gains, law: ImpedanceGains, limit: TorqueLimit, joints: int, delay_s: float = 0.0
    ) -> None:
        stiffness = np.repeat([gains.linear_stiffness, gains.rotational_stiffness], 3)
        floor = np.repeat([law.damping_floor, law.rotational_damping_floor], 3)
        self._memory = ImpedanceMemory(
            task=make_task_error(stiffness),
            tool=np.zeros((4, 3)),
            limits=limit.rows,
            inertia=np.zeros((6, 6)),
            floor=floor,
            rest=np.zeros(joints),
            rest_stiffness=law.nullspace_stiffness,
            torque_rate=limit.rate,
            force_n=gains.limits.force_n,
            power_w=gains.limits.force_n * gains.limits.speed_m_s,
            damping=floor.copy(),
            command_time=gains.command_time,
            age=np.full(1, INERTIA_PERIOD_S),
            delay_s=delay_s,
            stiffest=np.full(6, np.inf),
        )

    @property
    def memory(self) -> ImpedanceMemory:
        """What the law computes with."""
        return self._memory

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
        self._memory.age[0] = INERTIA_PERIOD_S
        self._memory.damping[:] = self._memory.floor
        self._memory.rest[:] = q

    def command(self, state: ArmState, reference: Reference, compliance: Compliance, period: float) -> Torque:
        """Return the joint torques (nv,) in N m for the next `period` s."""
        tau = np.empty_like(state.q)
        command_impedance(tau, self._memory, state, reference, compliance, period)
        return Torque(tau)


@inlined
def impedance(
    tau: Array,
    memory: ImpedanceMemory,
    state: ArmState,
    reference: SampledReference,
    compliance: AppliedCompliance,
    period: float,
) -> None:
    """Update inertia and damping if due, which the damping follows, and compute the torques.

    tau (nv,): N m, written. period: s.
    """
    memory.age[0] += period
    if memory.age[0] >= INERTIA_PERIOD_S:
        damping = np.empty(6)
        fastest = min(FASTEST_DECAY / period, DELAYED_DECAY / (memory.delay_s + 1e-9))
        design_damping(damping, memory, state, reference, compliance, fastest)
        step_lag(memory.damping, damping, lag_share(memory.age[0], memory.command_time), DAMPING_GRAIN)
        copy_vector(memory.damping, memory.task.rows[DAMPING])
        delay = memory.delay_s + 1e-9
        for i in range(6):
            by_inertia = DELAYED_SPRING * memory.inertia[i, i] / (delay * delay)
            memory.stiffest[i] = min(DELAYED_SHARE * memory.damping[i] / delay, by_inertia)
        memory.age[0] = 0.0
    impedance_torque(tau, memory, state, reference, compliance, period)


@inlined
def design_damping(
    damping: Array,
    memory: ImpedanceMemory,
    state: ArmState,
    reference: SampledReference,
    compliance: AppliedCompliance,
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
def tool_torque(tau: Array, memory: ImpedanceMemory, state: ArmState, compliance: AppliedCompliance) -> None:
    """exerted (6,) = W - K sat(e) - D (J_C dq - nu_d) - B over, along C; tau (nv,) = J_C^T (exerted + Lam_C a_d).

    exerted: N and N m; tau: N m. The force of springs, dampers and brakes is limited to `force_n`, and all torques are
    scaled down if their power exceeds `power_w`.
    """
    rows, axes = memory.task.rows, memory.task.axes
    exerted, force, in_base = rows[EXERTED], np.empty(6), np.empty(6)
    for i in range(6):
        spring = -min(compliance.stiffness[i], memory.stiffest[i]) * rows[ERROR, i]
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


@inlined
def impedance_torque(
    tau_out: Array,
    memory: ImpedanceMemory,
    state: ArmState,
    reference: SampledReference,
    compliance: AppliedCompliance,
    period: float,
) -> None:
    """Compute the torques tau_out (nv,) in N m for the next `period` s; store tool and errors in the memory.

    An arm with more than six joints keeps its posture.
    """
    copy_vector(state.tool.position, memory.tool[0])
    copy_matrix(state.tool.rotation, memory.tool[1:])
    q, dq, J = state.q, state.dq, state.jacobian
    tau, velocity = np.empty(q.size), np.empty(6)
    times(J, dq, velocity)
    compute_task_error(memory.task, state.tool, reference, compliance, velocity)
    tool_torque(tau, memory, state, compliance)
    if q.size > 6:
        posture = np.empty(q.size)
        posture_torque(posture, q, dq, J, memory.rest, memory.rest_stiffness)
        tau += posture
    limit_torque(tau_out, memory.limits, tau, q, state.bias, memory.torque_rate * period)


@compiled_when_called
def command_impedance(
    tau: OutVector,
    memory: ImpedanceMemory,
    state: ArmState,
    reference: Reference,
    compliance: Compliance,
    period: float,
) -> None:
    """Compute the torques tau (nv,) in N m for the next `period` s; the reference is in the base frame."""
    impedance(tau, memory, state, reference, compliance, period)
