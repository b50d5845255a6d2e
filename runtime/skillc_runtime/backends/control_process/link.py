"""The interface between the control process and the device of one arm: what a back end for a robot implements.

A back end implements `LinkDescription` and `RobotLink`, and calls `open_cell` of `opening`; all else is shared. The
control process runs this loop, in one thread, in which all methods of a link are called:

    link = description.make_link(); link.connect(); link.take_control(mode)
    repeat:  link.read(state)         waits for the device
             step(state, command)     measurement, control law, limits
             link.write(command)      exactly once after each `read`, while the link has control
             at most one call         set_load, tare, recover, take_control, give_back

`read` and `write` never call each other's work: a link that must answer each state, as the Franka Control Interface
does, can rely on the alternation. Without control (before `take_control`, after `give_back`, and while `condition` is
not "in-control") only `read` is called.

Conventions: SI units; joints in the order, with the zeros and signs, of the model that the arm's sheet names: a link
converts. Flange: the frame of the site `flange` of that model. Base: the frame of the arm's base in the world model.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Literal, Protocol, TypeAlias

import numpy as np

from skillc_runtime.devices.arm import Mode
from skillc_runtime.motion.arrays import OutVector
from skillc_runtime.motion.pose import Array

ConditionKind: TypeAlias = Literal[
    "ready", "in-control", "not-in-control", "wrong-mode", "protective-stop", "emergency-stop"
]
"""What a device is at present.

ready: `take_control` may succeed. in-control: commands of this link have effect. not-in-control: somebody else has
control, such as another program or the operator's panel. wrong-mode: the device takes no commands, such as without
power, with engaged brakes, or in a manual mode. protective-stop: it has stopped by itself, by a limit, a collision or a
reflex; `recover` acknowledges that. emergency-stop: somebody has to release a button at the device.
"""

LinkMode: TypeAlias = Mode | Literal["tool"]
"""What a link takes control for: one kind of commands; or "tool": kind "tool" while a skill controls the tool, by a
controller of the device, and kind "position" while it controls the joints."""

CommandKind: TypeAlias = Literal["nothing", "torque", "position", "velocity", "tool"]
KINDS: Final[tuple[CommandKind, ...]] = ("nothing", "torque", "position", "velocity", "tool")
"""The kinds of commands; the number of a kind is its place."""

WrenchKind: TypeAlias = Literal["none", "with-weight", "with-held-weight", "without-weight"]
"""Which wrench a device measures: none; with the weight of hand and load, of the load alone, or of neither."""


class LinkLost(Exception):
    """A device does not answer any more; the message names what is silent, and for how long."""


class ControlRefused(Exception):
    """A device does not give control, or does not take it back, and is as before; the message says what to do."""


@dataclass(frozen=True, slots=True)
class DeviceCondition:
    """The condition of a device, with a sentence for whoever stands before it; empty for ready and in-control."""

    kind: ConditionKind
    sentence: str = ""


@dataclass(frozen=True, slots=True)
class LinkAbilities:
    """What a device can do, as known once it is connected.

    modes: the commands that it takes. wrench: what `StateView.wrench` is. measures_effort: whether `StateView.effort`
    is measured. carries_weight: whether the device adds the torques against gravity of arm, hand and load itself, so
    that torque commands are without them; Coriolis torques are always commanded. tares: whether `tare` of the link is
    to be called; otherwise the control process subtracts the offset. silence_s: after which time without a new state
    `read` raises LinkLost. reconnects: whether `connect` may be called again after that; otherwise a new
    process connects.
    """

    modes: tuple[LinkMode, ...]
    wrench: WrenchKind = "none"
    measures_effort: bool = False
    carries_weight: bool = False
    tares: bool = False
    silence_s: float = 0.1
    reconnects: bool = True


@dataclass(frozen=True, slots=True)
class PointMass:
    """A mass in kg, with its centre (3,) in m in the frame of the flange."""

    mass_kg: float
    centre: Array


@dataclass(frozen=True, slots=True)
class StateView:
    """What a device has measured in one cycle: views of one contiguous array of float64, in this order.

    Written by `RobotLink.read`; all entries are NaN before the first one.

    stamp_s (1,): when it was measured, in s of the device's clock; unchanged where no new state has arrived.
    speed_share (1,): at which share of the commanded speeds the device moves, by a speed slider; 1 without. Motions are
    commanded with that share.
    q, dq (nv,): rad and rad/s. target (nv,): where the device's own servos want the joints, rad; q if it has none.
    effort (nv,): torques of the motors, with weight, in N m; zeros if it measures none.
    wrench (6,): of the environment on the hand, at the origin and along the axes of the flange, [N; N m]; zeros
    without sensor.
    """

    buffer: OutVector
    stamp_s: OutVector
    speed_share: OutVector
    q: OutVector
    dq: OutVector
    target: OutVector
    effort: OutVector
    wrench: OutVector


@dataclass(frozen=True, slots=True)
class CommandView:
    """What a device shall do until the next command: views of one contiguous array of float64, in this order.

    kind (1,): place in `KINDS`. values (nv,): N m (with or without weight, see `LinkAbilities`), rad or rad/s.

    The other entries say what the tool shall do, for a device that was taken for "tool", whose own controller holds and
    pushes the tool; all but `on_flange` are NaN while the joints are controlled. Quaternions have w first.
    pose (7,): the tool centre point in the base, position in m and quaternion. twist (6,): its speed, [m/s; rad/s], in
    base axes. on_flange (7,): the tool centre point on the flange. axes (4,): the compliance frame, along the base.
    stiffness (6,): N/m and N m/rad, along `axes`; 0 where it yields. push (6,): the wrench that the tool shall exert on
    the environment, N and N m, along `axes`.
    """

    buffer: OutVector
    kind: OutVector
    values: OutVector
    pose: OutVector
    twist: OutVector
    on_flange: OutVector
    axes: OutVector
    stiffness: OutVector
    push: OutVector


def make_state(joints: int) -> StateView:
    """Return a state of NaN, of an arm with so many joints."""
    return StateView(*_split(1, 1, joints, joints, joints, joints, 6))


def make_command(joints: int) -> CommandView:
    """Return a command of NaN that commands nothing, for an arm with so many joints."""
    command = CommandView(*_split(1, joints, 7, 6, 7, 4, 6, 6))
    command.kind[0] = KINDS.index("nothing")
    return command


class RobotLink(Protocol):
    """The connection to one arm; all methods are called in the same thread of the control process.

    `read` and `write` must not allocate much, log or connect. The other methods may take up to `CALL_S`; a link whose
    device forbids one of them in motion (the Franka Control Interface: the load) ends its control, does it, and takes
    control again, with the arm at rest.
    """

    @property
    def period_s(self) -> float:
        """The nominal time between two states in s; known after `connect`."""
        ...

    @property
    def abilities(self) -> LinkAbilities:
        """What the device can do; known after `connect`."""
        ...

    def connect(self) -> None:
        """Connect, or connect again after LinkLost if the link `reconnects`, without taking control; nothing moves.

        BackendUnavailable, with what does not answer and what to do: the address, the port, the mode of the device.
        """
        ...

    def read(self, state: StateView) -> None:
        """Wait for the device's next cycle and write all that was measured to `state`.

        A device that does not clock the loop is waited for until the next period (`Pacer` of `pacing`). LinkLost if
        nothing new has come for `silence_s` of `abilities`. A device that has stopped by itself is still read; what
        keeps it from moving is its `condition`.
        """
        ...

    def write(self, command: CommandView) -> None:
        """Send a command of the mode that was taken; LinkLost if that cannot be done.

        It has been checked against the limits. A command that the device refuses changes `condition`.
        """
        ...

    @property
    def condition(self) -> DeviceCondition:
        """The condition as of the last `read` or `write`; asked in every cycle, so it asks nobody."""
        ...

    def take_control(self, mode: LinkMode) -> None:
        """Take control with the arm at rest, so that it holds still until the first command; ControlRefused.

        Afterwards `condition` is "in-control".
        """
        ...

    def give_back(self) -> None:
        """Give control back, with the arm at rest or, if it does not answer, moving; the device brakes by itself.

        Nothing happens without control. Afterwards `condition` is not "in-control".
        """
        ...

    def recover(self) -> None:
        """Acknowledge a protective stop; StopPersists, with what somebody has to do, if its cause is still there.

        Afterwards `condition` is "ready". Nothing happens if the device has not stopped.
        """
        ...

    def set_load(self, hand: PointMass, held: PointMass) -> None:
        """Send the device what the flange carries: the hand by the model, and what it holds; each may be 0 kg.

        A device that knows its hand by a setting of its own uses only `held`.
        """
        ...

    def tare(self) -> None:
        """Let the wrench that is measured now be 0; called only if `abilities` say so, with the arm at rest."""
        ...

    def close(self) -> None:
        """Give control back and disconnect; idempotent, raises nothing."""
        ...


class LinkDescription(Protocol):
    """Where a device is and how it is spoken to: facts of the arm, as a dataclass that is pickled into its process.

    Its module is imported in the control process as well, so libraries of devices are imported in `make_link`, with
    BackendUnavailable and the name of the extra if they are missing.
    """

    @property
    def name(self) -> str:
        """The device and its address, for messages, such as "the robot at 192.168.1.2"."""
        ...

    def make_link(self) -> RobotLink:
        """Return a link that is not connected."""
        ...


CALL_S = 2.0
"""How long `take_control`, `give_back`, `recover`, `set_load`, `tare` and `connect` may take at most, in s."""


def _split(*sizes: int) -> list[OutVector]:
    """Return a new array of NaN of the sum of `sizes`, and views of its consecutive parts."""
    buffer = np.full(sum(sizes), np.nan)
    ends = np.cumsum(sizes)
    return [buffer, *(buffer[end - size : end] for size, end in zip(sizes, ends, strict=True))]
