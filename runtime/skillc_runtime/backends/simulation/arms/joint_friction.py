"""What gears do to torques: friction, by the LuGre model, with bristles that bend before a joint slips; ripple, and
motors that are weaker than is known; and torque control inside the arm.

Canudas de Wit, Olsson, Astrom, Lischinsky: A New Model for Control of Systems with Friction, IEEE Transactions on
Automatic Control 40(3), 1995, equations 2 to 6; with speed friction falls as in Hess, Soom: Friction at a Lubricated
Line Contact Operating at Oscillating Sliding Velocities, Journal of Tribology 112(1), 1990.

An arm with torque sensors between gears and links controls the torques of its links itself: what the sensor of a joint
misses of the command is added to the torque of the motor. Friction is in the gear, before the sensor, so that it is
left, with its ripple, only as far as it changes faster than that, and the error of the sensor is what the link gets
wrong. Le Tien, Albu-Schaeffer, De Luca, Hirzinger: Friction Observer and Compensation for Control of Robots with Joint
Torque Measurement, IROS 2008.
"""

from __future__ import annotations

from math import exp, inf
from typing import Final

import msgspec
import numpy as np

from skillc_runtime.backends.simulation.arms.geometry_errors import find_wave
from skillc_runtime.backends.simulation.arms.motors import Motors, Servos
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.backends.simulation.steps import OnMemory
from skillc_runtime.devices.reality import Sizes
from skillc_runtime.motion.arrays import OutVector, Vector
from skillc_runtime.motion.numerics.compiled import bind, compiled, inlined
from skillc_runtime.world.state.data_sheet import number_of
from skillc_runtime.world.state.terms import JOINT_TORQUE_TIME

STICKING: Final = 1.3
"""Friction of a joint at rest, in multiples of that of one that moves slowly."""

STRIBECK_SPEED: Final = 0.05
"""Speed in rad/s at which friction has fallen most of the way from that at rest."""

BENDING_RAD: Final = 2e-4
"""How far a joint moves before it slips."""

VISCOUS: Final = 0.3
"""What friction grows by for each rad/s, in multiples of that of a joint that moves slowly."""

DAMPING_S: Final = 0.001
"""Damping of the bristles, in multiples of their stiffness."""


KINDS: Final = ("jointFriction", "jointTorqueBias", "torqueRipple", "effortLoss", "transmissionError")
"""The imperfections of gears, motors and their sensors, as in `devices.reality`."""


class Friction(msgspec.Struct, frozen=True):
    """The friction of an arm's joints, and what else its gears do, (nv,) in N m, rad and rad/s.

    applied: torques on the joints, the friction included. added: 1 if motors write them in each step, so that the
    friction is added; 0 if friction is all there is. slow: friction of a joint that moves slowly; bent: of bristles.
    observed: what the arm makes up for; share: of the difference by which this moves in a step, 0 without sensors;
    bias: what the sensors add. ripple: its amplitude; wave: that of the errors of encoders. control: of the actuators,
    N m, or rad for servos with this stiffness, N m/rad, and damping, N m s/rad, 0 for others; effort: what is known to
    be the most, and strength: what is.
    """

    applied: OutVector
    slow: Vector
    dq: Vector
    bent: OutVector
    added: float
    step_s: float
    observed: OutVector
    share: float
    bias: Vector
    q: Vector
    ripple: Vector
    wave: Vector
    control: Vector
    stiffness: Vector
    damping: Vector
    effort: Vector
    strength: Vector


@inlined
def _limit(friction: Friction, j: int, more: float, lead: float) -> float:
    """Return what the motor of joint j adds to what its actuator exerts, if it is to exert `more` N m.

    lead: rad, by which its encoder is ahead.
    """
    stiffness, effort, strength = friction.stiffness[j], friction.effort[j], friction.strength[j]
    exerted: float = friction.control[j]
    if stiffness > 0.0:
        exerted = stiffness * (exerted - friction.q[j]) - friction.damping[j] * friction.dq[j]
    exerted = min(max(exerted, -effort), effort)
    most: float = min(max(exerted + more - stiffness * lead, -strength), strength)
    return most - exerted


@compiled
def rub(friction: Friction, now: float) -> int:
    """Apply friction in one step.

    With speed v, bending z, s(v) = F (1 + (k - 1) / (1 + (v / v_s)^2)) and stiffness F k / z_max:
    z' = v - stiffness |v| z / s(v), implicitly in z; torque = -(stiffness (z + T z') + b F v + A sin(w q)). The arm
    adds f, as far as its motors are strong enough, with f' = (-torque - bias - f) / T_f.
    """
    for j in range(friction.dq.size):
        v, slow, before = friction.dq[j], friction.slow[j], friction.bent[j]
        stiffness = slow * STICKING / BENDING_RAD
        most = slow * (1.0 + (STICKING - 1.0) / (1.0 + (v / STRIBECK_SPEED) * (v / STRIBECK_SPEED)))
        slipping = abs(v) / most if slow > 0.0 else 0.0
        bent = (before + friction.step_s * v) / (1.0 + friction.step_s * stiffness * slipping)
        friction.bent[j] = bent
        torque = stiffness * (bent + DAMPING_S * (bent - before) / friction.step_s) + VISCOUS * slow * v
        ripple, wave = friction.ripple[j], friction.wave[j]
        here = find_wave(friction.q[j])[0] if ripple != 0.0 or wave != 0.0 else 0.0
        torque += ripple * here
        more = _limit(friction, j, friction.observed[j], wave * here)
        friction.applied[j] = friction.added * friction.applied[j] - torque + more
        friction.observed[j] += friction.share * (torque - friction.bias[j] - friction.observed[j])
    return 0


def make_joint_friction(arm: ArmSpec, sizes: Sizes, motors: Motors, step_s: float) -> OnMemory | None:
    """Return what rubs in each step between the joints of an arm; None if nothing does."""
    joints, gains = motors.joints, motors.gains if isinstance(motors, Servos) else None
    if not any(each in sizes for each in KINDS):
        return None
    slow, bias, ripple, loss = (np.multiply(sizes.get(each, 0.0), joints.effort) for each in KINDS[:4])
    wave, none = np.broadcast_to(sizes.get(KINDS[4], 0.0), joints.dq.size).copy(), np.zeros(joints.dq.size)
    bent, added = none.copy(), 1.0 if arm.has_servos else 0.0
    time_s = number_of(arm.sheet.state, arm.sheet.individual, JOINT_TORQUE_TIME, inf)
    share = 1.0 - exp(-step_s / time_s)
    friction = Friction(
        joints.applied, slow, joints.dq, bent, added, step_s, none.copy(), share, bias, joints.q, ripple, wave,
        joints.control, *((none, none) if gains is None else (gains.stiffness.copy(), gains.damping.copy())),
        joints.effort, joints.effort - loss,
    )  # fmt: skip
    return OnMemory(bind(rub, friction))
