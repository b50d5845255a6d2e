"""Forward-dynamics compliance for arms that take joint speeds, with which they follow the virtual arm."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco

from skillc_runtime.controllers import forward_dynamics
from skillc_runtime.controllers.forward_dynamics import ForwardDynamicsGains
from skillc_runtime.controllers.gains import Gains, Number
from skillc_runtime.controllers.limits import SpeedLimit
from skillc_runtime.robots.arm import ArmLimits, ArmState, Mode
from skillc_runtime.robots.laws import Laws


@dataclass(frozen=True, slots=True)
class VelocityGains:
    """The compliance, and how joints are kept from drifting away from the virtual ones.

    tracking_rate 1/s: speed for every rad of error; tracking_time s: how late joints follow speeds, which is no error.
    """

    compliance: ForwardDynamicsGains
    tracking_rate: float
    tracking_time: float

    @property
    def mode(self) -> Mode:
        """Joint speeds."""
        return "velocity"

    @property
    def needs_force(self) -> bool:
        """Yes, as the compliance does."""
        return self.compliance.needs_force

    @property
    def release_damping(self) -> float:
        """Force per speed of a released axis, N s/m."""
        return self.compliance.release_damping

    def laws(self, gains: Gains, limits: ArmLimits, virtual: mujoco.MjModel, state: ArmState, period: float) -> Laws:
        """Make the laws of one arm."""
        return self.compliance.laws_within(
            SpeedLimit(limits, state.q, self.tracking_rate, self.tracking_time), gains, virtual
        )


def from_sheet(number: Number) -> VelocityGains:
    """Read the gains from an arm's data sheet."""
    return VelocityGains(forward_dynamics.from_sheet(number), number("trackingRate"), number("trackingTime"))
