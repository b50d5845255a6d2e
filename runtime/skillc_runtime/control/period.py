"""One control period of an arm: from its measured state to its command, on memory that stays where it is.

What has happened comes out as bits, so that nothing but numbers is touched in a period in which nothing has; Python
acts on them. See `driver` for what it does.
"""

from __future__ import annotations

from math import inf
from typing import Final

import msgspec
import numpy as np

from skillc_runtime.control.compliance_state import ComplianceMemory, follow_target
from skillc_runtime.control.laws.forward_dynamics import ForwardDynamicsMemory, move_virtual_arm
from skillc_runtime.control.laws.impedance import ImpedanceMemory, impedance
from skillc_runtime.control.laws.joint_position import computed_torque, move_servos
from skillc_runtime.control.laws.task_error import EXERTED
from skillc_runtime.control.laws.virtual_arm import VirtualState
from skillc_runtime.control.laws.virtual_chain import VirtualChain, compute_virtual
from skillc_runtime.control.limits import COMMANDED, DRIVEN
from skillc_runtime.control.momentum_observer import add_impulse
from skillc_runtime.control.push_memory import advance_pushes
from skillc_runtime.control.supervision.plausibility import check_signals
from skillc_runtime.control.supervision.safety import MEASURES_EFFORT, SafetyMemory, check_limits
from skillc_runtime.devices.arm import ArmState
from skillc_runtime.motion.arrays import OutMatrix, OutVector
from skillc_runtime.motion.joint_plan import JointPlan, use_ahead
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import copy_vector, squared, times
from skillc_runtime.motion.pose import Pose
from skillc_runtime.motion.reference_plan import ReferencePlan, sample_plan

NOT_FINITE, TOOL_MOVED, BEYOND_LIMIT, BAD_COMMAND, OVERLAY_OVER, PUSH_ACTS, BLOCKED, IMPLAUSIBLE = (
    1 << bit for bit in range(8)
)
"""Bits of what has happened: the measurement is no number; the tool was moved on the hand; a safety limit was exceeded;
the law yields no number; an overlay has faded out; a push has come to an action; the joints do not follow; what is
measured cannot be true."""

WATCHED: Final = NOT_FINITE | TOOL_MOVED | BEYOND_LIMIT | IMPLAUSIBLE
"""What is found before a command is computed."""

SEEN, LOST, TASK, IS_WATCHED = range(4)
"""Entries of `ArmMemory.clock`: s of the last period and all time lost between periods, by the clock of the cell; the
present s of motions; 1 if what is measured was checked already."""

LONGEST_GAP_S = 0.02
"""After a longer gap between control periods, or one below zero, motions are delayed by the lost time."""

TOOL_JUMP_M_S = 3.0
"""A tool that seems to move faster was moved on the hand, for example by grasping."""


class ArmMemory(msgspec.Struct, frozen=True):
    """What is measured of an arm, and what is kept of it between control periods.

    holds (nv,): what holds it at its last known position, N m or rad; bias_holds (1,): 1 for the former. place (3,): of
    the tool in the period before, m, in base. clock (4,): see above; period: s.
    """

    state: ArmState
    holds: OutVector
    bias_holds: float
    place: OutVector
    safety: SafetyMemory
    clock: OutVector
    period: float


@compiled
def begin_period(arm: ArmMemory, now: float) -> int:
    """Compute the time of motions in a period that begins at `now` s: it stops while the arm is not controlled."""
    clock = arm.clock
    gap = now - clock[SEEN]
    clock[SEEN] = now
    if not 0.0 <= gap <= max(LONGEST_GAP_S, 2 * arm.period):
        clock[LOST] += gap - arm.period
    clock[TASK] = now - clock[LOST]
    return 0


class ImpedancePeriod(msgspec.Struct, frozen=True):
    """All that a period under Cartesian impedance works on; pushes (n, m): a row each; tau (nv,): N m, the command."""

    arm: ArmMemory
    compliance: ComplianceMemory
    plan: ReferencePlan
    law: ImpedanceMemory
    pushes: OutMatrix
    tau: OutVector


@inlined
def watch(arm: ArmMemory) -> int:
    """Check the measured state; return bits. Nothing else is looked at if it is not finite."""
    state, place, square, period = arm.state, arm.place, 0.0, arm.period
    at = state.tool.position
    if not squared(state.q) + squared(state.dq) + squared(state.wrench) + squared(at) < inf:
        return NOT_FINITE
    if check_signals(arm.safety.signals, arm.safety.observer, state, period, arm.clock[LOST]):
        return IMPLAUSIBLE
    if arm.bias_holds != 0.0:
        copy_vector(state.bias, arm.holds)
    else:
        copy_vector(state.q, arm.holds)
    for i in range(3):
        square += (at[i] - place[i]) * (at[i] - place[i])
        place[i] = at[i]
    longest, events = TOOL_JUMP_M_S * period, 0
    if square > longest * longest:
        events = events | TOOL_MOVED
    if check_limits(arm.safety, state, period):
        events = events | BEYOND_LIMIT
    return events


@compiled
def watch_arm(arm: ArmMemory, now: float) -> int:
    """Check the measured state at the beginning of a period, at `now` s; return bits."""
    return watch(arm)


@inlined
def _begin(arm: ArmMemory, compliance: ComplianceMemory, plan: ReferencePlan) -> int:
    """Check the measured state; without a bit of `WATCHED` advance compliance and reference. Return bits."""
    events = 0 if arm.clock[IS_WATCHED] != 0.0 else watch(arm)
    if events != 0:
        return events
    follow_target(compliance, arm.period)
    return OVERLAY_OVER if sample_plan(plan, arm.clock[TASK]) else 0


@compiled
def control_by_impedance(memory: ImpedancePeriod, now: float) -> int:
    """Compute the command of the period that has begun, at `now` s; return bits.

    Nothing is commanded if something is found before; the caller acts on that, and calls again with `IS_WATCHED`.
    """
    arm, period = memory.arm, memory.arm.period
    events = _begin(arm, memory.compliance, memory.plan)
    if events & WATCHED:
        return events
    impedance(memory.tau, memory.law, arm.state, memory.plan, memory.compliance, period)
    if not squared(memory.tau) < inf:
        return events | BAD_COMMAND
    if arm.safety.limits[MEASURES_EFFORT] == 0.0:
        add_impulse(arm.safety.observer.impulse, memory.tau, arm.holds, period)
    contact = np.empty(3)
    times(memory.law.task.axes, memory.law.task.rows[EXERTED, :3], contact)
    for i in range(3):
        contact[i] = -contact[i]
    if advance_pushes(memory.pushes, contact, arm.safety, arm.state, period):
        events = events | PUSH_ACTS
    return events


class ForwardDynamicsPeriod(msgspec.Struct, frozen=True):
    """All that a period of forward-dynamics compliance works on; pushes (n, m): a row each."""

    arm: ArmMemory
    compliance: ComplianceMemory
    plan: ReferencePlan
    law: ForwardDynamicsMemory
    chain: VirtualChain
    virtual: VirtualState
    pushes: OutMatrix


@compiled
def control_by_forward_dynamics(memory: ForwardDynamicsPeriod, now: float) -> int:
    """Compute the command of the period that has begun, at `now` s, in the limits of the law; as the one above."""
    arm, law, virtual, period = memory.arm, memory.law, memory.virtual, memory.arm.period
    events = _begin(arm, memory.compliance, memory.plan)
    if events & WATCHED:
        return events
    copy_vector(arm.state.wrench, law.felt)
    commanded, tool = law.limits[COMMANDED], virtual.tool
    compute_virtual(
        memory.chain, commanded, law.dq, tool.position, tool.rotation, virtual.jacobian, virtual.inertia, virtual.bias
    )
    if not move_virtual_arm(law, virtual, arm.state.q, arm.state.dq, law.felt, memory.plan, memory.compliance, period):
        return events | BLOCKED
    if not squared(commanded) + squared(law.limits[DRIVEN]) < inf:
        return events | BAD_COMMAND
    if advance_pushes(memory.pushes, law.felt, arm.safety, arm.state, period):
        events = events | PUSH_ACTS
    return events


class JointPeriod(msgspec.Struct, frozen=True):
    """All that a period in which the joints are moved works on.

    plan: of their reference; limits: of the arm, see `TorqueLimit` and `JointLimit`; torque_rate: N m/s, and tau (nv,):
    N m, the command, for an arm that takes torques; pushes (n, m): a row each.
    """

    arm: ArmMemory
    compliance: ComplianceMemory
    plan: JointPlan
    limits: OutMatrix
    torque_rate: float
    tau: OutVector
    pushes: OutMatrix


@inlined
def _begin_joints(arm: ArmMemory, compliance: ComplianceMemory) -> int:
    """Check the measured state; without a bit of `WATCHED` advance compliance. Return bits."""
    events = 0 if arm.clock[IS_WATCHED] != 0.0 else watch(arm)
    if events == 0:
        follow_target(compliance, arm.period)
    return events


@inlined
def _end_joints(memory: JointPeriod) -> int:
    """Advance pushes; return bits."""
    arm = memory.arm
    return PUSH_ACTS if advance_pushes(memory.pushes, arm.state.wrench[:3], arm.safety, arm.state, arm.period) else 0


@compiled
def control_joints_by_torques(memory: JointPeriod, now: float) -> int:
    """Compute the torques of the period that has begun, at `now` s; return bits, as `control_by_impedance`."""
    arm, plan, period = memory.arm, memory.plan, memory.arm.period
    row = use_ahead(plan, arm.clock[TASK], period)
    events = _begin_joints(arm, memory.compliance)
    if events != 0:
        plan.used[0] -= 1.0
        return events
    longest = memory.torque_rate * period
    computed_torque(memory.tau, memory.limits, arm.state, plan.rows[row : row + 3], longest)
    if not squared(memory.tau) < inf:
        return BAD_COMMAND
    if arm.safety.limits[MEASURES_EFFORT] == 0.0:
        add_impulse(arm.safety.observer.impulse, memory.tau, arm.holds, period)
    return _end_joints(memory)


@compiled
def control_joints_by_servos(memory: JointPeriod, now: float) -> int:
    """Compute the positions or speeds of the period that has begun, at `now` s; return bits.

    As `control_by_impedance`.
    """
    arm, plan = memory.arm, memory.plan
    row = use_ahead(plan, arm.clock[TASK], arm.period)
    events = _begin_joints(arm, memory.compliance)
    if events != 0:
        plan.used[0] -= 1.0
        return events
    if not move_servos(memory.limits, arm.state, plan.rows[row : row + 3], arm.period):
        return BLOCKED
    if not squared(memory.limits[COMMANDED]) + squared(memory.limits[DRIVEN]) < inf:
        return BAD_COMMAND
    return _end_joints(memory)


class PushPeriod(msgspec.Struct, frozen=True):
    """All that pushes under any law work on; contact (3,): N, the force on the tool, in base."""

    arm: ArmMemory
    pushes: OutMatrix
    contact: OutVector


@compiled
def advance_all_pushes(memory: PushPeriod, now: float) -> int:
    """Advance pushes by the period that has begun at `now` s, after its command; return bits."""
    acts = advance_pushes(memory.pushes, memory.contact, memory.arm.safety, memory.arm.state, memory.arm.period)
    return PUSH_ACTS if acts else 0


def make_state(joints: int) -> ArmState:
    """Return the state of an arm with so many joints, to be written."""
    still = (np.zeros(joints) for _ in range(4))
    jacobian, mass = np.zeros((6, joints)), np.zeros((joints, joints))
    q, dq, bias, effort = still
    return ArmState(q, dq, Pose(np.zeros(3), np.eye(3)), jacobian, mass, bias, np.zeros(6), effort)


def copy_state(state: ArmState, out: ArmState) -> None:
    """Copy all that is measured."""
    out.q[:], out.dq[:], out.bias[:], out.effort[:], out.wrench[:] = (
        state.q, state.dq, state.bias, state.effort, state.wrench,
    )  # fmt: skip
    out.tool.position[:], out.tool.rotation[:] = state.tool.position, state.tool.rotation
    out.jacobian[:], out.mass_matrix[:] = state.jacobian, state.mass_matrix
