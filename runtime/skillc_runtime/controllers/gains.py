"""The numbers of the control laws, which the data sheet of an arm states; SI units throughout."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

Number: TypeAlias = Callable[[str], float]
"""Returns a number of a data sheet by its name there; raises KeyError where the sheet lacks it."""


@dataclass(frozen=True, slots=True)
class ImpedanceGains:
    """For a torque-controlled arm. Names as in the data sheet vocabulary.

    damping_floor N s/m, rotational_damping_floor N m s/rad: least damping, which is all that a released axis has;
    nullspace_stiffness N m/rad: pull towards the rest posture; torque_rate N m/s: greatest change of a joint torque.
    """

    damping_floor: float
    rotational_damping_floor: float
    nullspace_stiffness: float
    torque_rate: float


@dataclass(frozen=True, slots=True)
class ForwardDynamicsGains:
    """For a position-controlled arm with a force/torque sensor.

    admittance m/(s N), rotational_admittance rad/(s N m): steady tool velocity per wrench; admittance_time s: its lag.
    """

    admittance: float
    rotational_admittance: float
    admittance_time: float


@dataclass(frozen=True, slots=True)
class Gains:
    """What all compliant arms state, and what their law needs besides.

    linear_stiffness N/m, rotational_stiffness N m/rad: of every axis that no skill releases; command_time s: with which
    stiffness and wrench follow their commands; force_limit N, speed_limit m/s, acceleration_limit m/s^2: what skills
    may ask for.
    """

    law: ImpedanceGains | ForwardDynamicsGains
    linear_stiffness: float
    rotational_stiffness: float
    damping_ratio: float
    command_time: float
    force_limit: float
    speed_limit: float
    acceleration_limit: float

    @property
    def release_damping(self) -> float:
        """Force per speed, N s/m, with which a released axis moves when pushed: F = release_damping * v."""
        match self.law:
            case ImpedanceGains(damping_floor=floor):
                return floor
            case ForwardDynamicsGains(admittance=admittance):
                return 1 / admittance


def _impedance(number: Number) -> ImpedanceGains:
    floors = number("dampingFloor"), number("rotationalDampingFloor")
    return ImpedanceGains(*floors, number("nullspaceStiffness"), number("torqueRate"))


def _forward_dynamics(number: Number) -> ForwardDynamicsGains:
    return ForwardDynamicsGains(number("admittance"), number("rotationalAdmittance"), number("admittanceTime"))


LAWS: dict[str, Callable[[Number], ImpedanceGains | ForwardDynamicsGains]] = {
    "impedance": _impedance,
    "forward_dynamics": _forward_dynamics,
}
"""The laws by the names that the world model gives controllers."""


def gains(controller: str, number: Number) -> Gains:
    """Return the gains that a data sheet states for the controller of that name; KeyError names what is unknown."""
    if controller not in LAWS:
        raise KeyError(f"there is no controller {controller!r}; there are: {', '.join(sorted(LAWS))}")
    return Gains(
        LAWS[controller](number),
        number("linearStiffness"),
        number("rotationalStiffness"),
        number("dampingRatio"),
        number("commandTime"),
        number("forceLimit"),
        number("speedLimit"),
        number("accelerationLimit"),
    )
