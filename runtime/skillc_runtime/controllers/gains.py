"""The gains of an arm's controller, read from its data sheet; SI units. A controller is a file in this folder.

Such a module offers one function, `from_sheet(number: Number) -> LawGains`; the world model names the module.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from math import inf
from pkgutil import iter_modules
from typing import Protocol, TypeAlias

import mujoco

from skillc_runtime import controllers
from skillc_runtime.robots.arm import ArmLimits, ArmState, Mode
from skillc_runtime.robots.laws import Laws

Number: TypeAlias = Callable[[str], float]
"""Returns a number of a data sheet by its name there; raises an error that names it where the sheet lacks it."""


class UnknownController(ValueError):
    """There is no controller of that name; the message lists those there are."""


class LawGains(Protocol):
    """What one controller alone reads from a data sheet, and the laws it makes of it."""

    @property
    def mode(self) -> Mode:
        """Which commands the laws give."""
        ...

    @property
    def needs_force(self) -> bool:
        """Whether the laws live on the wrench that the arm measures."""
        ...

    @property
    def release_damping(self) -> float:
        """Force per speed, N s/m, with which a released axis moves when pushed: F = release_damping * v."""
        ...

    def laws(self, gains: Gains, limits: ArmLimits, virtual: mujoco.MjModel, state: ArmState, period: float) -> Laws:
        """Make the laws of one arm; ValueError where they cannot be stable at the control period in s."""
        ...


@dataclass(frozen=True, slots=True)
class Gains:
    """What all compliant arms state, and what their law needs besides.

    linear_stiffness N/m, rotational_stiffness N m/rad: of every axis that no skill releases; command_time s: with which
    stiffness and wrench follow their commands; force_limit N, speed_limit m/s, acceleration_limit m/s^2: what skills
    may ask for; jerk_limit m/s^3: of planned motions of the tool, endless unless the sheet states one.
    """

    law: LawGains
    linear_stiffness: float
    rotational_stiffness: float
    damping_ratio: float
    command_time: float
    force_limit: float
    speed_limit: float
    acceleration_limit: float
    jerk_limit: float = inf

    @property
    def release_damping(self) -> float:
        """Force per speed, N s/m, with which a released axis moves when pushed: F = release_damping * v."""
        return self.law.release_damping


def gains(controller: str, number: Number) -> Gains:
    """Return the gains that a data sheet states for the controller of that name; UnknownController if there is none."""
    known = _controllers()
    if controller not in known:
        raise UnknownController(f"there is no controller {controller!r}; there are: {', '.join(known)}")
    return Gains(
        known[controller](number),
        number("linearStiffness"),
        number("rotationalStiffness"),
        number("dampingRatio"),
        number("commandTime"),
        number("forceLimit"),
        number("speedLimit"),
        number("accelerationLimit"),
    )


def known_controllers() -> tuple[str, ...]:
    """Return the names that arms may state for their controllers."""
    return tuple(_controllers())


def _controllers() -> dict[str, Callable[[Number], LawGains]]:
    """Return what reads the gains of each controller: the modules of the folder that offer it, by their names."""
    names = sorted(module.name for module in iter_modules(controllers.__path__))
    modules = {name: import_module(f"{controllers.__name__}.{name}") for name in names}
    return {name: module.from_sheet for name, module in modules.items() if hasattr(module, "from_sheet")}
