"""The interface between a controller and an arm, simulated or real."""

from __future__ import annotations

from typing import Literal, Protocol, TypeAlias, TypeVar, assert_never

import msgspec

from skillc_runtime.motion.arrays import Matrix, Vector
from skillc_runtime.motion.pose import Array, Pose


class ArmState(msgspec.Struct, frozen=True):
    """The measurements of an arm at one instant, in the arm's base frame, at the tool centre point.

    q, dq (nv,): rad, rad/s. tool: tool centre point in base. jacobian (6, nv): [linear m; angular rad] per rad.
    mass_matrix (nv, nv): kg m^2. bias (nv,): N m, gravity and Coriolis of arm, gripper and payload. wrench (6,): of
    the environment on the tool, N and N m, base axes, without tool weight; zeros if the arm has no sensor for it.
    effort (nv,): N m, exerted by the motors since the last measurement; zeros if the arm does not measure it.
    """

    q: Vector
    dq: Vector
    tool: Pose
    jacobian: Matrix
    mass_matrix: Matrix
    bias: Vector
    wrench: Vector
    effort: Vector


class Torque(msgspec.Struct, frozen=True):
    """Joint torques (nv,) in N m, including gravity compensation."""

    tau: Array


class JointPosition(msgspec.Struct, frozen=True):
    """Joint positions (nv,) in rad for the arm's own servos."""

    q: Array


class JointVelocity(msgspec.Struct, frozen=True):
    """Joint speeds (nv,) in rad/s for the arm's own servos."""

    dq: Array


Command: TypeAlias = Torque | JointPosition | JointVelocity
Mode: TypeAlias = Literal["torque", "position", "velocity"]
"""The kind of commands that an arm takes."""


CommandT = TypeVar("CommandT", bound=Torque | JointPosition | JointVelocity)


def command_values(command: Command) -> Array:
    """Return the values (nv,) of a command: N m, rad or rad/s."""
    match command:
        case Torque(tau=tau):
            return tau
        case JointPosition(q=q):
            return q
        case JointVelocity(dq=dq):
            return dq
        case _:
            assert_never(command)


def copy_command(command: CommandT) -> CommandT:
    """Return a command of the same kind with a copy of its values."""
    return type(command)(command_values(command).copy())


class ModeRefused(Exception):
    """An arm cannot switch to a mode and stays in its present one; the message says why."""


class NotOffered(Exception):
    """A device cannot do what is asked for, and stays as it is; the message says why."""


class ArmLoad(msgspec.Struct, frozen=True):
    """What an arm's hand holds: its mass in kg, with its centre (3,) in m in its own frame, which is at `held`.

    tool: the tool centre point then. Both poses are in the frame of the tool centre point of the empty hand.
    """

    mass_kg: float
    centre: Array
    held: Pose
    tool: Pose


class ArmLimits(msgspec.Struct, frozen=True):
    """Limits of joints: range (nv, 2) rad, velocity (nv,) rad/s, effort (nv,) N m, acceleration (nv,) rad/s^2.

    The acceleration is infinite if it is not known.
    """

    range: Matrix
    velocity: Vector
    effort: Vector
    acceleration: Vector


class Capabilities(msgspec.Struct, frozen=True):
    """The modes of an arm, whether it measures the wrench at its tool and the effort of its motors, and its limits.

    never_repeats: whether what it measures is never exactly the same twice while it moves or is loaded otherwise.
    measures_link_torques: whether the effort is that on the links, measured behind gears and their friction.
    command_delay_s: the greatest time from a measurement to the effect of what follows from it, beyond the control
    period, as far as it is known.
    """

    modes: tuple[Mode, ...]
    feels_force: bool
    measures_effort: bool
    limits: ArmLimits
    never_repeats: bool = False
    command_delay_s: float = 0.0
    measures_link_torques: bool = False


class Arm(Protocol):
    """An arm that is read and commanded once a control period; it holds still if commands stop.

    A class that is derived from this one has what is implemented here: what an arm may lack. `tests/backends` tests
    every implementation.
    """

    @property
    def capabilities(self) -> Capabilities:
        """The capabilities of the arm."""
        ...

    @property
    def interface(self) -> Mode:
        """The kind of commands that the arm takes at present."""
        ...

    def switch(self, mode: Mode) -> None:
        """Take commands of this kind from now on, holding still until the first; ModeRefused if it cannot."""
        ...

    def state(self) -> ArmState:
        """Return the present state; its arrays are read-only and may be the arm's own, valid until the next call."""
        ...

    @property
    def lasting_state(self) -> ArmState | None:
        """What every call of `state` returns, if it is always the same object; None if it returns new arrays.

        The arrays of such a state keep their places in memory and are in C order, and `command` keeps no command.
        """
        return None

    def command(self, command: Command) -> None:
        """Take a command for the next control period; TypeError for another kind than `interface`."""
        ...

    def set_load(self, load: ArmLoad | None) -> None:
        """Count this as held from now on, by the next `state` at the latest; None for the empty hand.

        Called on grasp and release. `state` is at the tool centre point of the load, and without its weight.
        """
        ...

    @property
    def measured_s(self) -> float | None:
        """When the last `state` was measured, in s of the arm's own clock; None if the arm dates nothing."""
        return None

    def flange_at(self, q: Array) -> Pose | None:
        """Return the flange in base for joints q (nv,) in rad by the arm's own model; None if it has none."""
        return None

    @property
    def mean_wrench(self) -> Array | None:
        """The mean wrench (6,) in N and N m of the last second or so, along the axes of the sensor; None if not known.

        `tare` lets it be 0.
        """
        return None

    def tare(self) -> None:
        """Let the wrench that is measured now be 0 from now on, while nothing touches the tool; NotOffered."""
        raise NotOffered("the arm has no sensor that can be tared")

    @property
    def force_drift(self) -> Array | None:
        """How fast the force (3,) of its sensor drifts, in N/s, in the frame of the sensor; None if not known."""
        return None

    def correct_bias(self, torque: Array) -> None:
        """Add a torque (nv,) in N m to the bias from now on, beside what was added before; NotOffered."""
        raise NotOffered("the arm's model of its weight cannot be corrected")

    @property
    def braked(self) -> bool:
        """Whether the brakes hold the joints; commands have no effect then."""
        return False

    def set_brakes(self, on: bool) -> None:
        """Engage or release the brakes of an arm at rest; NotOffered without any."""
        if on:
            raise NotOffered("the arm has no brakes that can be engaged")

    def drop_brakes(self) -> None:
        """Engage the brakes of an arm that may be moving: commands have an effect until they act; NotOffered."""
        raise NotOffered("the arm has no brakes that can be engaged")
