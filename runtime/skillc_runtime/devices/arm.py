"""The seam between a controller and an arm, simulated or real."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol, TypeAlias, assert_never

from skillc_runtime.motion.arrays import Matrix, Vector
from skillc_runtime.motion.pose import Array, Pose


@dataclass(frozen=True, slots=True)
class ArmState:
    """What an arm measures at one instant, in the arm's base frame; reference point is the tool centre point.

    q, dq (nv,): rad, rad/s. tool: tool centre point in base. jacobian (6, nv): [linear m; angular rad] per rad.
    mass_matrix (nv, nv): kg m^2. bias (nv,): N m, gravity and Coriolis of arm, gripper and payload. wrench (6,): what
    the environment does to the tool, N and N m, base axes, tool weight removed; zeros where the arm has no such sensor.
    """

    q: Vector
    dq: Vector
    tool: Pose
    jacobian: Matrix
    mass_matrix: Matrix
    bias: Vector
    wrench: Vector


@dataclass(frozen=True, slots=True)
class Torque:
    """Joint torques (nv,) in N m, gravity compensation included."""

    tau: Array


@dataclass(frozen=True, slots=True)
class JointPosition:
    """Joint positions (nv,) in rad for the arm's own servos."""

    q: Array


@dataclass(frozen=True, slots=True)
class JointVelocity:
    """Joint speeds (nv,) in rad/s for the arm's own servos."""

    dq: Array


Command: TypeAlias = Torque | JointPosition | JointVelocity
Mode: TypeAlias = Literal["torque", "position", "velocity"]
"""Which of the commands an arm takes."""


def command_values(command: Command) -> Array:
    """Return what a command consists of, (nv,)."""
    match command:
        case Torque(tau=tau):
            return tau
        case JointPosition(q=q):
            return q
        case JointVelocity(dq=dq):
            return dq
        case _:
            assert_never(command)


class ModeRefused(Exception):
    """An arm does not go over to a mode; it stays in the one it is in. The message is for people."""


@dataclass(frozen=True, slots=True)
class ArmLimits:
    """What an arm can do: joint range (nv, 2) rad, velocity (nv,) rad/s, effort (nv,) N m, acceleration (nv,) rad/s^2.

    The acceleration is infinite where nobody states it.
    """

    range: Array
    velocity: Array
    effort: Array
    acceleration: Array


@dataclass(frozen=True, slots=True)
class Capabilities:
    """What an arm offers: the modes it knows, whether it measures the wrench at its tool, its limits."""

    modes: tuple[Mode, ...]
    feels_force: bool
    limits: ArmLimits


class Arm(Protocol):
    """An arm that is read and commanded once a control period; one that is not commanded any more holds still.

    `tests/backends` says what is expected of every implementation.
    """

    @property
    def capabilities(self) -> Capabilities:
        """What the arm offers."""
        ...

    @property
    def interface(self) -> Mode:
        """Which command the arm takes at present."""
        ...

    def switch(self, mode: Mode) -> None:
        """Take commands of this kind from now on, holding still until the first; ModeRefused where it cannot."""
        ...

    def state(self) -> ArmState:
        """Return the present state; its arrays are read-only and may be the arm's own, valid until the next call."""
        ...

    def command(self, command: Command) -> None:
        """Take a command for the next control period; TypeError for a kind the interface does not take."""
        ...
