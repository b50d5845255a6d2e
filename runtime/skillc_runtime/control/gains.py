"""The gains of an arm's controller, read from its data sheet; SI units. `controllers` makes controllers of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TypeAlias

from skillc_runtime.devices.arm import Mode
from skillc_runtime.devices.arm_driver import TaskLimits

NumberReader: TypeAlias = Callable[[str], float]
"""Returns a number of a data sheet by its name there; raises an error that names it where the sheet lacks it."""


class UnknownController(ValueError):
    """There is no controller of that name; the message lists those there are."""


@dataclass(frozen=True, slots=True)
class ImpedanceGains:
    """Of Cartesian impedance, for an arm that takes torques. Names as in the data sheet vocabulary.

    damping_floor N s/m, rotational_damping_floor N m s/rad: least damping, which is all that a released axis has;
    nullspace_stiffness N m/rad: pull towards the rest posture; torque_rate N m/s: greatest change of a joint torque.
    """

    damping_floor: float
    rotational_damping_floor: float
    nullspace_stiffness: float
    torque_rate: float

    @property
    def mode(self) -> Mode:
        """Torques."""
        return "torque"

    @property
    def needs_force(self) -> bool:
        """No: springs push."""
        return False

    @property
    def release_damping(self) -> float:
        """Force per speed of a released axis, N s/m: nothing but the least damping holds it back."""
        return self.damping_floor


@dataclass(frozen=True, slots=True)
class ForwardDynamicsGains:
    """Of forward-dynamics compliance, for an arm with servos of its own and a force/torque sensor.

    admittance m/(s N), rotational_admittance rad/(s N m): steady tool velocity per wrench; admittance_time s: its lag.
    """

    admittance: float
    rotational_admittance: float
    admittance_time: float

    @property
    def mode(self) -> Mode:
        """Joint positions."""
        return "position"

    @property
    def needs_force(self) -> bool:
        """Yes: an arm that does not feel what it touches does not yield."""
        return True

    @property
    def release_damping(self) -> float:
        """Force per speed of a released axis, N s/m."""
        return 1 / self.admittance


@dataclass(frozen=True, slots=True)
class VelocityGains:
    """Of forward-dynamics compliance for an arm that takes speeds, and what keeps joints with the virtual ones.

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


LawGains: TypeAlias = ImpedanceGains | ForwardDynamicsGains | VelocityGains
"""What one controller alone reads from a data sheet.

mode: which commands it gives; needs_force: whether it needs the wrench that the arm measures; release_damping N s/m:
force per speed with which a released axis moves when it is pushed, F = release_damping * v.
"""


@dataclass(frozen=True, slots=True)
class Gains:
    """What all compliant arms state, and what their law needs besides.

    linear_stiffness N/m, rotational_stiffness N m/rad: of every axis that no skill releases; damping_ratio: 1 is
    critical; command_time s: with which stiffness and wrench follow their commands; limits: what skills may ask for.
    """

    law: LawGains
    linear_stiffness: float
    rotational_stiffness: float
    damping_ratio: float
    command_time: float
    limits: TaskLimits


def read_gains(controller: str, number: NumberReader) -> Gains:
    """Return the gains that a data sheet states for the controller of that name; UnknownController if there is none."""
    if controller not in CONTROLLERS:
        raise UnknownController(f"there is no controller {controller!r}; there are: {', '.join(CONTROLLERS)}")
    return Gains(
        CONTROLLERS[controller](number),
        number("linearStiffness"),
        number("rotationalStiffness"),
        number("dampingRatio"),
        number("commandTime"),
        TaskLimits(number("forceLimit"), number("speedLimit"), number("accelerationLimit")),
    )


def _read_forward_dynamics(number: NumberReader) -> ForwardDynamicsGains:
    return ForwardDynamicsGains(number("admittance"), number("rotationalAdmittance"), number("admittanceTime"))


def _read_velocity(number: NumberReader) -> VelocityGains:
    return VelocityGains(_read_forward_dynamics(number), number("trackingRate"), number("trackingTime"))


def _read_impedance(number: NumberReader) -> ImpedanceGains:
    floors = number("dampingFloor"), number("rotationalDampingFloor")
    return ImpedanceGains(*floors, number("nullspaceStiffness"), number("torqueRate"))


CONTROLLERS: Mapping[str, Callable[[NumberReader], LawGains]] = MappingProxyType(
    {
        "forward_dynamics": _read_forward_dynamics,
        "forward_dynamics_velocity": _read_velocity,
        "impedance": _read_impedance,
    }
)
"""What reads the gains of each controller from a data sheet, by the names that arms state for their controllers."""
