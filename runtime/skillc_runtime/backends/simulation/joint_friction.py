"""Friction of joints: the LuGre model, with bristles that bend before a joint slips.

Canudas de Wit, Olsson, Astrom, Lischinsky: A New Model for Control of Systems with Friction, IEEE Transactions on
Automatic Control 40(3), 1995, equations 2 to 6; with speed friction falls as in Hess, Soom: Friction at a Lubricated
Line Contact Operating at Oscillating Sliding Velocities, Journal of Tribology 112(1), 1990.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from skillc_runtime.backends.simulation.motors import Joints
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.backends.simulation.steps import OnMemory
from skillc_runtime.devices.reality import Sizes
from skillc_runtime.motion.arrays import OutVector, Vector
from skillc_runtime.motion.numerics.compiled import bind, compiled

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


@dataclass(frozen=True, slots=True)
class Friction:
    """The friction of an arm's joints, (nv,) in N m, rad and rad/s.

    applied: torques on the joints, the friction included. added: 1 if motors write them in each step, so that the
    friction is added; 0 if friction is all there is. slow: friction of a joint that moves slowly; bent: of bristles.
    """

    applied: OutVector
    slow: Vector
    dq: Vector
    bent: OutVector
    added: float
    step_s: float


@compiled
def rub(friction: Friction, now: float) -> int:
    """Apply friction in one step.

    With speed v, bending z, s(v) = F (1 + (k - 1) / (1 + (v / v_s)^2)) and stiffness F k / z_max:
    z' = v - stiffness |v| z / s(v), implicitly in z; torque = -(stiffness (z + T z') + b F v).
    """
    for j in range(friction.dq.size):
        v, slow, before = friction.dq[j], friction.slow[j], friction.bent[j]
        stiffness = slow * STICKING / BENDING_RAD
        most = slow * (1.0 + (STICKING - 1.0) / (1.0 + (v / STRIBECK_SPEED) * (v / STRIBECK_SPEED)))
        bent = (before + friction.step_s * v) / (1.0 + friction.step_s * stiffness * abs(v) / most)
        friction.bent[j] = bent
        torque = stiffness * (bent + DAMPING_S * (bent - before) / friction.step_s) + VISCOUS * slow * v
        friction.applied[j] = friction.added * friction.applied[j] - torque
    return 0


def make_joint_friction(arm: ArmSpec, sizes: Sizes, joints: Joints, step_s: float) -> OnMemory | None:
    """Return what rubs in each step between the joints of an arm; None if nothing does."""
    share = sizes.get("jointFriction")
    if share is None:
        return None
    slow = np.multiply(share, joints.effort)
    bent, added = np.zeros(joints.dq.size), 1.0 if arm.has_servos else 0.0
    return OnMemory(bind(rub, Friction(joints.applied, slow, joints.dq, bent, added, step_s)))
