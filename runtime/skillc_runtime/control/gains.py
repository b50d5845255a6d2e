"""The gains of an arm's controller, read from its data sheet; SI units. `controllers` creates controllers from them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, TypeAlias, get_args

import msgspec

from skillc_runtime.devices.arm import Mode
from skillc_runtime.devices.arm_driver import TaskLimits
from skillc_runtime.platforms.python_modules import import_named

NumberReader: TypeAlias = Callable[[str], float]
"""Returns a number of a data sheet by name, or raises an error that names the missing one."""


LAW_METHODS = ("reset", "command")
"""The methods that a control law must have, see `control.controller.Controller`."""


class UnknownController(ValueError):
    """There is no controller of that name; the message lists the existing ones."""


class ImpedanceGains(msgspec.Struct, frozen=True):
    """Gains of Cartesian impedance, for a torque-controlled arm. Names as in the data sheet vocabulary.

    damping_floor N s/m, rotational_damping_floor N m s/rad: least damping, the only one of a released axis;
    nullspace_stiffness N m/rad: towards the rest posture; torque_rate N m/s: greatest change of a joint torque.
    """

    damping_floor: float
    rotational_damping_floor: float
    nullspace_stiffness: float
    torque_rate: float

    @property
    def mode(self) -> Mode:
        """The commands that the law gives: torques."""
        return "torque"

    @property
    def needs_force(self) -> bool:
        """Whether the law needs a measured wrench: no, it pushes open loop."""
        return False

    @property
    def release_damping(self) -> float:
        """Force per speed of a released axis, N s/m: the least damping."""
        return self.damping_floor


class ForwardDynamicsGains(msgspec.Struct, frozen=True):
    """Gains of forward-dynamics compliance, for an arm with its own servos and a force/torque sensor.

    admittance m/(s N), rotational_admittance rad/(s N m): steady tool velocity per wrench; admittance_time s: its lag.
    """

    admittance: float
    rotational_admittance: float
    admittance_time: float

    @property
    def mode(self) -> Mode:
        """The commands that the law gives: joint positions."""
        return "position"

    @property
    def needs_force(self) -> bool:
        """Whether the law needs a measured wrench: yes."""
        return True

    @property
    def release_damping(self) -> float:
        """Force per speed of a released axis, N s/m."""
        return 1 / self.admittance


class VelocityGains(msgspec.Struct, frozen=True):
    """Gains of forward-dynamics compliance for a velocity-controlled arm, whose joints track the virtual ones.

    tracking_rate 1/s: speed per rad of error; tracking_time s: lag of the joints behind speeds, which is not an error.
    """

    compliance: ForwardDynamicsGains
    tracking_rate: float
    tracking_time: float

    @property
    def mode(self) -> Mode:
        """The commands that the law gives: joint speeds."""
        return "velocity"

    @property
    def needs_force(self) -> bool:
        """Whether the law needs a measured wrench: yes."""
        return self.compliance.needs_force

    @property
    def release_damping(self) -> float:
        """Force per speed of a released axis, N s/m."""
        return self.compliance.release_damping


class RobotGains(msgspec.Struct, frozen=True):
    """Gains of a law that runs on the robot's side, as far as they have to be known here.

    damping_floor N s/m: how that law brakes a released axis.
    """

    damping_floor: float

    @property
    def mode(self) -> Mode:
        """The commands for the joints: positions; the tool gets targets."""
        return "position"

    @property
    def needs_force(self) -> bool:
        """Whether the law needs a measured wrench: yes, nothing else tells here what the tool touches."""
        return True

    @property
    def release_damping(self) -> float:
        """Force per speed of a released axis, N s/m."""
        return self.damping_floor


class OwnGains(msgspec.Struct, frozen=True):
    """What the law of a user reads from the data sheet: `number` returns any number of it.

    law: a class as `control.own_law.OwnLaw`; mode, needs_force, release_damping: as below.
    """

    name: str
    law: Any
    number: NumberReader
    mode: Mode
    needs_force: bool

    @property
    def release_damping(self) -> float:
        """Force per speed of a released axis, N s/m: that of the shipped law for the same commands."""
        return self.number("dampingFloor") if self.mode == "torque" else 1 / self.number("admittance")


LawGains: TypeAlias = ImpedanceGains | ForwardDynamicsGains | VelocityGains | RobotGains | OwnGains
"""The gains of one kind of controller.

mode: the commands that it gives; needs_force: whether it needs a measured wrench; release_damping N s/m: force per
speed of a released axis, F = release_damping * v.
"""


class Gains(msgspec.Struct, frozen=True):
    """The gains of all compliant arms, and those of their law.

    linear_stiffness N/m, rotational_stiffness N m/rad: of every axis that is not released; damping_ratio: 1 is
    critical; command_time s: time constant with which stiffness and wrench follow commands; limits: of skills.
    """

    law: LawGains
    linear_stiffness: float
    rotational_stiffness: float
    damping_ratio: float
    command_time: float
    limits: TaskLimits


def read_gains(controller: str, number: NumberReader) -> Gains:
    """Return the gains that a data sheet states for a controller by name; UnknownController if there is none."""
    return Gains(
        read_law(controller, number),
        number("linearStiffness"),
        number("rotationalStiffness"),
        number("dampingRatio"),
        number("commandTime"),
        TaskLimits(number("forceLimit"), number("speedLimit"), number("accelerationLimit")),
    )


def read_law(controller: str, number: NumberReader) -> LawGains:
    """Return the gains of a law by the name of its controller, `module:Class` for a user's; else UnknownController."""
    if ":" in controller:
        return load_own_law(controller, number)
    if controller in CONTROLLERS:
        return CONTROLLERS[controller](number)
    raise UnknownController(f"there is no controller {controller!r}; there are: {', '.join(CONTROLLERS)}")


def load_own_law(name: str, number: NumberReader) -> OwnGains:
    """Import the class that `module:Class` names; UnknownController if it is not there or cannot be used."""
    module, _, attribute = name.partition(":")
    try:
        law = getattr(import_named(module), attribute)
    except Exception as error:
        raise UnknownController(f"the controller {name!r} cannot be imported: {error}") from error
    mode: Any = getattr(law, "mode", None)
    if mode not in get_args(Mode):
        raise UnknownController(f"the controller {name!r} needs an attribute `mode`: {', '.join(get_args(Mode))}")
    missing = [method for method in LAW_METHODS if not hasattr(law, method)]
    if missing:
        raise UnknownController(f"the controller {name!r} has no {', '.join(f'`{each}`' for each in missing)}")
    return OwnGains(name, law, number, mode, bool(getattr(law, "needs_force", False)))


def _read_forward_dynamics(number: NumberReader) -> ForwardDynamicsGains:
    return ForwardDynamicsGains(number("admittance"), number("rotationalAdmittance"), number("admittanceTime"))


def _read_velocity(number: NumberReader) -> VelocityGains:
    return VelocityGains(_read_forward_dynamics(number), number("trackingRate"), number("trackingTime"))


def _read_robot(number: NumberReader) -> RobotGains:
    return RobotGains(number("dampingFloor"))


def _read_impedance(number: NumberReader) -> ImpedanceGains:
    floors = number("dampingFloor"), number("rotationalDampingFloor")
    return ImpedanceGains(*floors, number("nullspaceStiffness"), number("torqueRate"))


CONTROLLERS: Mapping[str, Callable[[NumberReader], LawGains]] = MappingProxyType(
    {
        "forward_dynamics": _read_forward_dynamics,
        "forward_dynamics_velocity": _read_velocity,
        "impedance": _read_impedance,
        "on_robot": _read_robot,
    }
)
"""Functions that read the gains of each controller from a data sheet, by the name of the controller."""
