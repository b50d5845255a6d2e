"""Forward-dynamics compliance for position-controlled arms with a force sensor, which follow a virtual arm.

w_C = -K sat(e) + W + W_ext;  a = A w_C / T + nu_d / T + a_d;  ddq = H^-1 (J_C^T a - c)
dq <- g dq + (1 - g) T ddq, g = exp(-h/T);  q <- q + h dq
Scherzinger, Roennau, Dillmann 2017; gains per second, Coriolis forces c, feed-forward along stiff axes. C: compliance
frame. Along the axis of a push A is less where something stiff is touched, see `contact_stiffness`, and along all axes
where the tool would oscillate, see `passivity`. Most of the speed
beyond the limit of the compliance is removed.
"""

from __future__ import annotations

from math import exp

import msgspec
import numpy as np

from skillc_runtime.control.contact_stiffness import (
    STIFFNESS,
    forget_stiffness,
    identify_stiffness,
    stiffest_contact,
)
from skillc_runtime.control.gains import ForwardDynamicsGains, Gains
from skillc_runtime.control.laws.task_error import (
    ACCELERATION,
    ERROR,
    HELD,
    MEASURED,
    TWIST,
    TaskError,
    compute_task_error,
    make_task_error,
    speed_excess,
)
from skillc_runtime.control.laws.virtual_arm import VirtualArm, VirtualState
from skillc_runtime.control.limits import COMMANDED, FASTEST, JointLimit, limit_joints
from skillc_runtime.control.passivity import KEPT, fill_tank, make_tank, watch_energy
from skillc_runtime.control.push_memory import FALL_SHARE
from skillc_runtime.devices.arm import ArmState, Command
from skillc_runtime.motion.arrays import OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled_when_called, inlined
from skillc_runtime.motion.numerics.linear import cholesky, cholesky_solve, times, transposed_times
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import AppliedCompliance, Compliance, Reference, SampledReference

BRAKED = 0.9
"""Share of the excess of the tool's speed that is removed."""


class ForwardDynamicsMemory(msgspec.Struct, frozen=True):
    """Parameters and state of the law of one arm, kept between control periods; C is the compliance frame.

    dq (nv,): rad/s, of the virtual arm; task: errors along C; limits (9, nv): see `JointLimit`; rate (6,): admittance
    over its lag, 1/kg and 1/(kg m^2); lag: s; felt (6,): the wrench on the tool, N and N m, base axes;
    contact (4,): see `contact_stiffness`; stiffest: N/m, up to which the rate is not reduced; tank (4,): see
    `passivity`.
    """

    dq: OutVector
    task: TaskError
    limits: OutMatrix
    rate: Vector
    lag: float
    felt: OutVector
    contact: OutVector
    stiffest: float
    tank: OutVector


class ForwardDynamics:
    """The law for one arm. It integrates from the last command, never from the measurement.

    Arrays are reused. Joints (nv,) in rad and rad/s; the reference is in the base frame.
    """

    def __init__(
        self, gains: Gains, law: ForwardDynamicsGains, limit: JointLimit, arm: VirtualArm, delay_s: float = 0.0
    ) -> None:
        self._limit, self._arm = limit, arm
        self._memory = ForwardDynamicsMemory(
            dq=np.zeros(arm.joints),
            task=make_task_error(np.repeat([gains.linear_stiffness, gains.rotational_stiffness], 3)),
            limits=limit.rows,
            rate=np.repeat([law.admittance, law.rotational_admittance], 3) / law.admittance_time,
            lag=law.admittance_time,
            felt=np.zeros(6),
            contact=np.zeros(4),
            stiffest=stiffest_contact(law.admittance, law.admittance_time, delay_s),
            tank=make_tank(),
        )

    @property
    def memory(self) -> ForwardDynamicsMemory:
        """What the law computes with."""
        return self._memory

    @property
    def limit(self) -> JointLimit:
        """The last stage of each command."""
        return self._limit

    @property
    def arm(self) -> VirtualArm:
        """The virtual arm."""
        return self._arm

    @property
    def tool(self) -> Pose:
        """The tool centre point, in base, at the commanded joints; a copy."""
        return self._arm.tool

    @property
    def contact_wrench(self) -> Array:
        """The measured wrench (6,) in N and N m, base axes; a copy."""
        return self._memory.felt.copy()

    def reset(self, state: ArmState, q: Array, dq: Array) -> None:
        """Start from joint positions q (nv,) in rad and speeds dq (nv,) in rad/s."""
        self._arm.mount_tool(state.q, state.tool)
        self._arm.update_kinematics(q)
        self._memory.dq[:] = dq

    def command(self, state: ArmState, reference: Reference, compliance: Compliance, period: float) -> Command:
        """Return the joint positions or speeds to command for the next `period` s, within limits."""
        self._memory.felt[:] = state.wrench
        arm, limit = self._arm, self._limit
        arm.update_kinematics(limit.q)
        arm.update_dynamics(self._memory.dq)
        followed = virtual_motion(
            self._memory, arm.state, state.q, state.dq, state.wrench, reference, compliance, period
        )
        return limit.command_if_followed(followed, state)


@inlined
def _watch_contact(
    memory: ForwardDynamicsMemory, virtual: VirtualState, compliance: AppliedCompliance, period: float
) -> tuple[int, float]:
    """Return the axis of C along which the tool pushes, -1 for none, and the share of the admittance along it."""
    rows, axes, velocity, pushed = memory.task.rows, memory.task.axes, np.empty(3), -1
    for i in range(3):
        if compliance.wrench[i] != 0.0:
            pushed = i
    if pushed < 0:
        forget_stiffness(memory.contact, 0.0)
        return pushed, 1.0
    times(virtual.jacobian[:3], memory.dq, velocity)
    speed = axes[0, pushed] * velocity[0] + axes[1, pushed] * velocity[1] + axes[2, pushed] * velocity[2]
    approach = abs(compliance.fastest[pushed]) / FALL_SHARE
    identify_stiffness(memory.contact, speed, rows[MEASURED, pushed], approach, period)
    stiffness = memory.contact[STIFFNESS]
    return pushed, memory.stiffest / stiffness if stiffness > memory.stiffest else 1.0


@inlined
def _watch_energy(
    memory: ForwardDynamicsMemory, virtual: VirtualState, wrench: Vector, speeds: Vector, period: float
) -> float:
    """Return the share of the admittance with which the tool is passive, while it pushes."""
    rows, axes, in_base, velocity = memory.task.rows, memory.task.axes, np.empty(6), np.empty(6)
    times(virtual.jacobian, speeds, in_base)
    transposed_times(axes, in_base[:3], velocity[:3])
    transposed_times(axes, in_base[3:], velocity[3:])
    for i in range(6):
        velocity[i] -= rows[TWIST, i]
    return watch_energy(memory.tank, wrench, velocity, period)


@inlined
def move_virtual_arm(
    memory: ForwardDynamicsMemory,
    virtual: VirtualState,
    measured: Vector,
    speeds: Vector,
    felt: Vector,
    reference: SampledReference,
    compliance: AppliedCompliance,
    period: float,
) -> bool:
    """Compute dq (nv,) in rad/s, all scaled down if a joint would be too fast, and the limited command.

    Return False if the arm does not follow.
    measured: (nv,) in rad, the joints.
    speeds: (nv,) in rad/s, of the joints.
    felt: (6,) in N and N m, the wrench on the tool, base axes.
    period: s.
    """
    dq, rows, axes, lag = memory.dq, memory.task.rows, memory.task.axes, memory.lag
    compute_task_error(memory.task, virtual.tool, reference, compliance, felt)
    push, in_base, torque, ddq = np.empty(6), np.empty(6), np.empty(dq.size), np.empty(dq.size)
    pushed, reduced = _watch_contact(memory, virtual, compliance, period)
    for i in range(6):
        push[i] = rows[MEASURED, i] + compliance.wrench[i] - compliance.stiffness[i] * rows[ERROR, i]
    share = _watch_energy(memory, virtual, push, speeds, period)
    if pushed < 0 or rows[HELD, pushed] == 1.0:  # an axis that has become stiff again is held, and yields to nothing
        fill_tank(memory.tank)
        share = 1.0
    for i in range(6):
        beside = i < 3 and i != pushed
        used = min(share / KEPT, 1.0) if beside else share
        push[i] *= memory.rate[i] * min(used, reduced if i == pushed else 1.0)
        push[i] += rows[TWIST, i] / lag + rows[ACCELERATION, i]
    for i in range(3):
        push[i] -= BRAKED * speed_excess(lag * push[i], compliance.fastest[i]) / lag
    times(axes, push[:3], in_base[:3])
    times(axes, push[3:], in_base[3:])
    transposed_times(virtual.jacobian, in_base, torque)
    for j in range(dq.size):
        torque[j] -= virtual.bias[j]
    cholesky(virtual.inertia)
    cholesky_solve(virtual.inertia, torque, ddq)
    keep, excess, wanted = exp(-period / lag), 1.0, torque
    for j in range(dq.size):
        dq[j] = keep * dq[j] + (1 - keep) * lag * ddq[j]
        excess = max(excess, abs(dq[j] / memory.limits[FASTEST, j]))
    for j in range(dq.size):
        dq[j] /= excess
        wanted[j] = memory.limits[COMMANDED, j] + period * dq[j]
    return limit_joints(memory.limits, wanted, measured, period)


@compiled_when_called
def virtual_motion(
    memory: ForwardDynamicsMemory,
    virtual: VirtualState,
    measured: Vector,
    speeds: Vector,
    felt: Vector,
    reference: Reference,
    compliance: Compliance,
    period: float,
) -> bool:
    """Compute dq (nv,) in rad/s and the limited command; see `move_virtual_arm`.

    measured: (nv,) in rad, the joints.
    speeds: (nv,) in rad/s, of the joints.
    felt: (6,) in N and N m, the wrench on the tool, base axes.
    period: s.
    """
    return move_virtual_arm(memory, virtual, measured, speeds, felt, reference, compliance, period)
