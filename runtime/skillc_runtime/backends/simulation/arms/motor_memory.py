"""What the motors of a simulated arm do in each step of a simulation, on memory that machine code shares."""

from __future__ import annotations

import msgspec

from skillc_runtime.backends.simulation.arms.command_link import CommandLink, send
from skillc_runtime.motion.arrays import OutVector, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.numerics.linear import copy_vector
from skillc_runtime.motion.pose import Array

SILENT, LEFT = 0, 1
"""Entries of `MotorMemory.counts`: steps since the last command; steps in which a position is still approached."""


@inlined
def update_targets(
    control: Array, speed: Array, q: Array, dq: Array, lead: Array, farthest: Array, timestep: float
) -> None:
    """Move the targets `control` (nv,) in rad of servos by speed (nv,) in rad/s for a simulation step in s.

    lead (nv,): kv / kp in s, by which a target is ahead of a joint that moves freely; farthest (nv,): rad, the further
    lead that needs the full effort. While all speeds are zero, the target of such a joint becomes its position.
    """
    still = True
    for j in range(q.size):
        still = still and speed[j] == 0.0
    for j in range(q.size):
        even = q[j] + lead[j] * dq[j]
        control[j] = min(max(control[j] + timestep * speed[j], even - farthest[j]), even + farthest[j])
        if still and abs(control[j] - even) >= farthest[j]:
            control[j] = q[j]


class MotorMemory(msgspec.Struct, frozen=True):
    """What the motors of an arm work on in each step; (nv,) in rad, rad/s, N m.

    counts (2,): see above; longest: the greatest number of steps without a command. control, applied: written to the
    actuators. bias: measured last; q, dq: present. Of servos: target, the position or speed that is commanded; lead in
    s and farthest, see `_pursue`; step_s.
    """

    counts: OutVector
    longest: float
    control: OutVector
    applied: OutVector
    bias: Vector
    q: Vector
    dq: Vector
    target: OutVector
    lead: Vector
    farthest: Vector
    step_s: float


@inlined
def _count(motors: MotorMemory) -> int:
    """Count a step; return 1 if commands have stopped."""
    motors.counts[SILENT] += 1.0
    return 1 if motors.counts[SILENT] > motors.longest else 0


@compiled
def exert(motors: MotorMemory, now: float) -> int:
    """Let motors exert the torques that were set by the command, for one step."""
    return _count(motors)


@compiled
def approach(motors: MotorMemory, now: float) -> int:
    """Move servos linearly so that they arrive at the target in the last step of the control period."""
    stopped = _count(motors)
    if stopped != 0:
        return stopped
    copy_vector(motors.bias, motors.applied)
    left = motors.counts[LEFT]
    if left > 0.0:
        for j in range(motors.control.size):
            way = motors.target[j] - motors.control[j]
            motors.control[j] = motors.target[j] if left == 1.0 else motors.control[j] + way / left
        motors.counts[LEFT] = left - 1.0
    return 0


@compiled
def pursue(motors: MotorMemory, now: float) -> int:
    """Move servos with the speeds `target` for one step."""
    stopped = _count(motors)
    if stopped != 0:
        return stopped
    copy_vector(motors.bias, motors.applied)
    update_targets(motors.control, motors.target, motors.q, motors.dq, motors.lead, motors.farthest, motors.step_s)
    return 0


class Taking(msgspec.Struct, frozen=True):
    """How motors take the commands of a law: its values (nv,), and where they are put; steps: that they last."""

    values: Vector
    target: OutVector
    counts: OutVector
    steps: float


@compiled
def take_command(taking: Taking, now: float) -> int:
    """Take a command for the next control period."""
    copy_vector(taking.values, taking.target)
    taking.counts[SILENT], taking.counts[LEFT] = 0.0, taking.steps
    return 0


class LateTaking(msgspec.Struct, frozen=True):
    """How motors take commands that a line brings; see `Taking`."""

    taking: Taking
    link: CommandLink


@compiled
def take_late_command(late: LateTaking, now: float) -> int:
    """Send a command, and take the one that arrives in this control period, if one does."""
    taking = late.taking
    if send(late.link, taking.values, taking.target):
        taking.counts[SILENT], taking.counts[LEFT] = 0.0, taking.steps
    return 0
