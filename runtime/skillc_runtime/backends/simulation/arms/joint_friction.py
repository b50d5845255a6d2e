"""Friction of joints: the LuGre model, with bristles that bend before a joint slips; and torque control inside the arm.

Canudas de Wit, Olsson, Astrom, Lischinsky: A New Model for Control of Systems with Friction, IEEE Transactions on
Automatic Control 40(3), 1995, equations 2 to 6; with speed friction falls as in Hess, Soom: Friction at a Lubricated
Line Contact Operating at Oscillating Sliding Velocities, Journal of Tribology 112(1), 1990.

An arm with torque sensors between gears and links controls the torques of its links itself: what the sensor of a joint
misses of the command is added to the torque of the motor. Friction is in the gear, before the sensor, so that it is
left only as far as it changes faster than that, and the error of the sensor is what the link gets wrong. Le Tien,
Albu-Schaeffer, De Luca, Hirzinger: Friction Observer and Compensation for Control of Robots with Joint Torque
Measurement, IROS 2008.
"""

from __future__ import annotations

from math import exp, inf
from typing import Final

import msgspec
import numpy as np

from skillc_runtime.backends.simulation.arms.motors import Joints
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.backends.simulation.steps import OnMemory
from skillc_runtime.devices.reality import Sizes
from skillc_runtime.motion.arrays import OutVector, Vector
from skillc_runtime.motion.numerics.compiled import bind, compiled
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


class Friction(msgspec.Struct, frozen=True):
    """The friction of an arm's joints, (nv,) in N m, rad and rad/s.

    applied: torques on the joints, the friction included. added: 1 if motors write them in each step, so that the
    friction is added; 0 if friction is all there is. slow: friction of a joint that moves slowly; bent: of bristles.
    observed: what the arm makes up for; share: of the difference by which this moves in a step, 0 without sensors;
    bias: what the sensors add.
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


@compiled
def rub(friction: Friction, now: float) -> int:
    """Apply friction in one step.

    With speed v, bending z, s(v) = F (1 + (k - 1) / (1 + (v / v_s)^2)) and stiffness F k / z_max:
    z' = v - stiffness |v| z / s(v), implicitly in z; torque = -(stiffness (z + T z') + b F v). The arm adds f, with
    f' = (-torque - bias - f) / T_f.
    """
    for j in range(friction.dq.size):
        v, slow, before = friction.dq[j], friction.slow[j], friction.bent[j]
        stiffness = slow * STICKING / BENDING_RAD
        most = slow * (1.0 + (STICKING - 1.0) / (1.0 + (v / STRIBECK_SPEED) * (v / STRIBECK_SPEED)))
        slipping = abs(v) / most if slow > 0.0 else 0.0
        bent = (before + friction.step_s * v) / (1.0 + friction.step_s * stiffness * slipping)
        friction.bent[j] = bent
        torque = stiffness * (bent + DAMPING_S * (bent - before) / friction.step_s) + VISCOUS * slow * v
        friction.applied[j] = friction.added * friction.applied[j] - torque + friction.observed[j]
        friction.observed[j] += friction.share * (torque - friction.bias[j] - friction.observed[j])
    return 0


def make_joint_friction(arm: ArmSpec, sizes: Sizes, joints: Joints, step_s: float) -> OnMemory | None:
    """Return what rubs in each step between the joints of an arm; None if nothing does."""
    slow, bias = (np.multiply(sizes.get(each, 0.0), joints.effort) for each in ("jointFriction", "jointTorqueBias"))
    if not slow.any() and not bias.any():
        return None
    slow, bias = (each * np.ones(joints.dq.size) for each in (slow, bias))
    bent, added = np.zeros(joints.dq.size), 1.0 if arm.has_servos else 0.0
    time_s = number_of(arm.sheet.state, arm.sheet.individual, JOINT_TORQUE_TIME, inf)
    share = 1.0 - exp(-step_s / time_s)
    friction = Friction(joints.applied, slow, joints.dq, bent, added, step_s, np.zeros(slow.size), share, bias)
    return OnMemory(bind(rub, friction))
