"""Control laws of users: classes that arms name as "module:Class" instead of the name of a shipped controller."""

from __future__ import annotations

from typing import ClassVar, Protocol

import msgspec
import mujoco

from skillc_runtime.control.controller import ControlError, Controller
from skillc_runtime.control.gains import Gains, NumberReader, OwnGains
from skillc_runtime.control.limits import JointLimit, TorqueLimit
from skillc_runtime.devices.arm import ArmLimits, ArmState, Command, Mode
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Compliance, Reference


class LawSetup(msgspec.Struct, frozen=True):
    """What a law is made from.

    number: returns a number of the arm's data sheet by the name of its property; gains: stiffness, damping ratio,
    limits of skills. limit: its `step` is the last stage of each command; the arm shares it with the joint controller.
    limits: of the joints; virtual: the model of the arm alone; period: the control period in s.
    """

    number: NumberReader
    gains: Gains
    limit: TorqueLimit | JointLimit
    limits: ArmLimits
    virtual: mujoco.MjModel
    period: float


class OwnLaw(Controller, Protocol):
    """A law of a user: a `Controller` with the kind of its commands, made from a `LawSetup`."""

    mode: ClassVar[Mode]
    needs_force: ClassVar[bool] = False
    """Whether it needs a force/torque sensor."""

    def __init__(self, setup: LawSetup) -> None: ...


class CheckedLaw:
    """Calls the law of a user: what it raises is a ControlError, so that the arm is held and the run ends."""

    def __init__(self, law: OwnGains, setup: LawSetup) -> None:
        self._name = law.name
        try:
            self._law: Controller = law.law(setup)
        except Exception as error:
            raise ValueError(self._describe(error)) from error

    @property
    def tool(self) -> Pose:
        """The tool centre point, in base, that the law compares with its reference."""
        return self._law.tool

    @property
    def contact_wrench(self) -> Array:
        """The wrench (6,) of the environment on the tool, N and N m, base axes."""
        return self._law.contact_wrench

    def reset(self, state: ArmState, q: Array, dq: Array) -> None:
        """Start from joint positions and speeds. q (nv,): rad; dq (nv,): rad/s."""
        self._law.reset(state, q, dq)

    def command(self, state: ArmState, reference: Reference, compliance: Compliance, period: float) -> Command:
        """Return the command for the next `period` s; ControlError if the law raises anything."""
        try:
            return self._law.command(state, reference, compliance, period)
        except ControlError:
            raise
        except Exception as error:
            raise ControlError(self._describe(error)) from error

    def _describe(self, error: Exception) -> str:
        return f"the controller {self._name!r} raised {type(error).__name__}: {error}"
