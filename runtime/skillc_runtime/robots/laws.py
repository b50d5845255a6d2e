"""The controllers of one arm, made from its gains; they share its limits, so that changing between them is smooth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import assert_never

import mujoco

from skillc_runtime.controllers.controller import Controller, JointController
from skillc_runtime.controllers.forward_dynamics import ForwardDynamics
from skillc_runtime.controllers.gains import ForwardDynamicsGains, Gains, ImpedanceGains
from skillc_runtime.controllers.impedance import Impedance, damping_rate
from skillc_runtime.controllers.joint_position import ComputedTorque, JointServo
from skillc_runtime.controllers.limits import JointLimit, TorqueLimit
from skillc_runtime.controllers.virtual_arm import VirtualArm
from skillc_runtime.motion.pose import Array
from skillc_runtime.robots.arm import ArmLimits, ArmState


@dataclass(frozen=True, slots=True)
class Laws:
    """One law for the tool, one for the joints, and what both obey."""

    tool: Controller
    joints: JointController
    limit: TorqueLimit | JointLimit

    def joints_now(self, state: ArmState) -> Array:
        """Return the joints (nv,) from which a motion goes on: those commanded last, else the measured ones."""
        return (self.limit.q if isinstance(self.limit, JointLimit) else state.q).copy()


def laws(gains: Gains, limits: ArmLimits, virtual: mujoco.MjModel, state: ArmState, period: float) -> Laws:
    """Make an arm's laws; ValueError where its damping cannot be stable at the control period in s."""
    match gains.law:
        case ImpedanceGains() as law:
            rate = damping_rate(state, law.damping_floor, law.rotational_damping_floor)
            if rate * period > 1:
                raise ValueError(f"the damping decays with {rate:.0f}/s: too fast for a control period of {period} s")
            torque = TorqueLimit(limits, law.torque_rate)
            return Laws(Impedance(gains, law, torque, state.q.size), ComputedTorque(torque, state.q.size), torque)
        case ForwardDynamicsGains() as law:
            joint = JointLimit(limits, state.q)
            return Laws(ForwardDynamics(gains, law, joint, VirtualArm(virtual)), JointServo(joint), joint)
        case _:
            assert_never(gains.law)
