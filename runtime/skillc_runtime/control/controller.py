"""The protocol of compliant Cartesian laws."""

from __future__ import annotations

from typing import Protocol

from skillc_runtime.devices.arm import ArmState, Command
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.reference import Compliance, Reference


class ControlError(Exception):
    """A controller cannot continue safely; the message says why. The arm has been commanded to hold."""


class Controller(Protocol):
    """A compliant Cartesian law. Reference and compliance are in the arm's base frame, see `motion.reference`."""

    @property
    def tool(self) -> Pose:
        """The tool centre point, in base, that the law compares with its reference."""
        ...

    @property
    def contact_wrench(self) -> Array:
        """The wrench (6,) of the environment on the tool, measured or estimated; N and N m, base axes, at the tool."""
        ...

    def reset(self, state: ArmState, q: Array, dq: Array) -> None:
        """Start from what was commanded last, or measured. q (nv,): rad; dq (nv,): rad/s."""
        ...

    def command(self, state: ArmState, reference: Reference, compliance: Compliance, period: float) -> Command:
        """Return the command for the next `period` s."""
        ...
