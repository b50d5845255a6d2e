"""What changes in each control period of a cell, as copies of memory: reading costs a fraction of a microsecond."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

import msgspec

from skillc_runtime.devices.control_report import ControlReport
from skillc_runtime.motion.numerics.program import Part
from skillc_runtime.motion.pose import Pose

Place: TypeAlias = tuple[int, int]
"""Address and size of an array of float64."""

Places: TypeAlias = tuple[Place, ...]

ReadBytes = Callable[[], bytes]
"""Returns a copy of an array of float64."""


class LiveArm(msgspec.Struct, frozen=True):
    """An arm with `joints` joints, in its base frame, whose pose in the world `base` returns.

    measured (2, joints): angles in rad, speeds in rad/s. wrench (6,): N and N m, on the tool, by a force-torque
    sensor; None without one. reference (8, 3): the rows of `Reference`; NaN while the joints are controlled. stamp
    (1,): when that was measured, in s of the arm's own clock; None if it has none but the cell's. velocity (3,): m/s,
    of the tool as measured. force (3,): N that the tool is commanded to exert, along the axes of its reference; 0
    without a push. None for either if it is not known. timing (2,): how many control periods have been lost so far,
    and by how many s the last one was late; None if none can be. control: how the process is that controls it; None
    without one.
    """

    individual: str
    joints: int
    measured: ReadBytes
    wrench: ReadBytes | None
    reference: ReadBytes
    base: Callable[[], Pose]
    stamp: ReadBytes | None = None
    velocity: ReadBytes | None = None
    force: ReadBytes | None = None
    timing: ReadBytes | None = None
    control: Callable[[], ControlReport] | None = None


class LiveSensors(msgspec.Struct, frozen=True):
    """The sensors of a simulation, (count,); `faces` has of each tool where those of its working face begin.

    These are the normal force in N, position (3,) m, unit quaternion (4,), velocity (3,) m/s, true and in the world.
    """

    count: int
    read: ReadBytes
    faces: tuple[tuple[str, int], ...]


class LiveBodies(msgspec.Struct, frozen=True):
    """The bodies of the model of a simulation: positions (n, 3) in m and unit quaternions (n, 4) in the world."""

    positions: ReadBytes
    quaternions: ReadBytes


def _read_nothing() -> bytes:
    return b""


NO_SENSORS, NO_BODIES = LiveSensors(0, _read_nothing, ()), LiveBodies(_read_nothing, _read_nothing)
"""What a real cell has of the sensors and the model of a simulation."""


class LiveSignals(msgspec.Struct, frozen=True):
    """What a cell offers: the time in s, arms in order of IRI, sensors, bodies; `listeners` are called in each period.

    `period_s` is the control period; that of a device with its own time may vary. Listeners are called after the
    controllers; they must neither wait nor raise. `refresh` brings all of it up to now, by whoever may call `advance`.

    `places` returns where in memory, address and size, all is that arms and sensors return copies of, in their order,
    and `parts` takes part in each period instead of listeners; None for a cell whose signals have no lasting places.
    """

    period_s: float
    now: Callable[[], float]
    arms: Sequence[LiveArm]
    sensors: LiveSensors = NO_SENSORS
    bodies: LiveBodies = NO_BODIES
    listeners: list[Callable[[], None]] = msgspec.field(default_factory=list)
    refresh: Callable[[], None] = lambda: None
    places: Callable[[], Places] | None = None
    parts: list[Part] = msgspec.field(default_factory=list)
