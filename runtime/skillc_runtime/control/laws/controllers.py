"""Creates the controller of an arm's tool, and its limits, from gains."""

from __future__ import annotations

from typing import assert_never

import msgspec
import mujoco

from skillc_runtime.control.controller import Controller
from skillc_runtime.control.gains import (
    ForwardDynamicsGains,
    Gains,
    ImpedanceGains,
    OwnGains,
    RobotGains,
    VelocityGains,
)
from skillc_runtime.control.laws.damping import damping_rate
from skillc_runtime.control.laws.forward_dynamics import ForwardDynamics
from skillc_runtime.control.laws.impedance import Impedance
from skillc_runtime.control.laws.own_law import CheckedLaw, LawSetup
from skillc_runtime.control.laws.robot_law import RobotLaw
from skillc_runtime.control.laws.virtual_arm import VirtualArm
from skillc_runtime.control.limits import JointLimit, SpeedLimit, TorqueLimit
from skillc_runtime.devices.arm import ArmLimits, ArmState
from skillc_runtime.motion.pose import Array


class ControllerPair(msgspec.Struct, frozen=True):
    """A controller for the tool, and the limits that it shares with that of the joints, so switching is smooth."""

    tool: Controller
    limit: TorqueLimit | JointLimit

    def joints_now(self, state: ArmState) -> Array:
        """Return the joints (nv,) in rad from which a motion continues: those commanded last, else the measured."""
        return (self.limit.q if isinstance(self.limit, JointLimit) else state.q).copy()

    def joints_held(self, state: ArmState) -> Array:
        """Return the joints (nv,) in rad at which the arm is held if it must stop at once."""
        return (self.limit.holding_joints(state) if isinstance(self.limit, JointLimit) else state.q).copy()

    def speeds_now(self, state: ArmState) -> Array:
        """Return the joint speeds (nv,) in rad/s from which a motion continues: those commanded last, else measured."""
        return (self.limit.dq if isinstance(self.limit, JointLimit) else state.dq).copy()


def make_controllers(
    gains: Gains, limits: ArmLimits, virtual: mujoco.MjModel, state: ArmState, period: float, delay_s: float = 0.0
) -> ControllerPair:
    """Return the controllers of an arm in a state, for a control period in s; `virtual` is of `load_virtual_model`.

    delay_s: s, by which commands may be late at most. Raises ValueError if they cannot be stable at that period.
    """
    match gains.law:
        case ImpedanceGains() as law:
            return _impedance(gains, law, limits, state, period, delay_s)
        case ForwardDynamicsGains() as law:
            return _forward_dynamics(gains, law, JointLimit(limits, state.q), virtual, delay_s)
        case VelocityGains(compliance=law, tracking_rate=rate, tracking_time=lag):
            return _forward_dynamics(gains, law, SpeedLimit(limits, state.q, rate, lag), virtual, delay_s)
        case RobotGains():
            joint_limit = JointLimit(limits, state.q)
            return ControllerPair(RobotLaw(joint_limit, state), joint_limit)
        case OwnGains() as law:
            return _own(
                LawSetup(law.number, gains, _limit_for(law, limits, state), limits, virtual, period), law, state
            )
        case never:
            assert_never(never)


def _limit_for(law: OwnGains, limits: ArmLimits, state: ArmState) -> TorqueLimit | JointLimit:
    match law.mode:
        case "torque":
            return TorqueLimit(limits, law.number("torqueRate"))
        case "position":
            return JointLimit(limits, state.q)
        case "velocity":
            return SpeedLimit(limits, state.q, law.number("trackingRate"), law.number("trackingTime"))
        case never:
            assert_never(never)


def _own(setup: LawSetup, law: OwnGains, state: ArmState) -> ControllerPair:
    limit = setup.limit
    return ControllerPair(CheckedLaw(law, setup), limit)


def _impedance(
    gains: Gains, law: ImpedanceGains, limits: ArmLimits, state: ArmState, period: float, delay_s: float
) -> ControllerPair:
    rate = damping_rate(state, law.damping_floor, law.rotational_damping_floor)
    if rate * period > 1:
        raise ValueError(f"the damping decays with {rate:.0f}/s: too fast for a control period of {period} s")
    limit = TorqueLimit(limits, law.torque_rate)
    return ControllerPair(Impedance(gains, law, limit, state.q.size, delay_s), limit)


def _forward_dynamics(
    gains: Gains, law: ForwardDynamicsGains, limit: JointLimit, virtual: mujoco.MjModel, delay_s: float
) -> ControllerPair:
    return ControllerPair(ForwardDynamics(gains, law, limit, VirtualArm(virtual), delay_s), limit)
