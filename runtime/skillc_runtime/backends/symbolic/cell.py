"""A cell without bodies: the world model is all of it, and time passes only in `advance`."""

from __future__ import annotations

import struct
from collections.abc import Collection, Sequence
from typing import NoReturn

from skillc_runtime.devices.backend import NO_STOPS, BackendStart, BackendUnavailable, DeviceStops
from skillc_runtime.devices.capabilities import BackendCapabilities
from skillc_runtime.devices.checkpoints import CheckpointError
from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.facts import Evidence
from skillc_runtime.world.state.model import WorldModel

_TIME = struct.Struct("<d")


def make_backend(world: WorldModel, start: BackendStart) -> SymbolicCell:
    """Return a cell without bodies; it is `MakeBackend`."""
    if start.observed:
        raise BackendUnavailable("it has no devices to look at; use the back end of your robot")
    return SymbolicCell(world, start.saved)


class SymbolicCell:
    """A cell in lock step without devices, implementing `Cell` and `Backend`; nothing is asked but its facts.

    Skills that use no devices run in it as in any other; `act_as_declared` of `skillc_model.declared` makes all skills
    of a library act by what they declare. What is written as measured counts as idealised.
    """

    broken: str | None = None
    stops: DeviceStops = NO_STOPS

    def __init__(self, world: WorldModel, saved: bytes | None = None) -> None:
        """Build it, at the time at which an earlier one was `saved`; CheckpointError if that cannot be read."""
        self._world = world
        self.now = 0.0 if saved is None else _read_time(saved)
        self.capabilities = BackendCapabilities(lock_step=self, checkpoints=self, symbolic=True)
        world.weigh_evidence(_weigh_evidence)

    @property
    def cell(self) -> SymbolicCell:
        """The cell as skills see it."""
        return self

    @property
    def clock(self) -> SymbolicCell:
        """The clock of the cell."""
        return self

    @property
    def world(self) -> WorldModel:
        """The world model."""
        return self._world

    @property
    def watchdog(self) -> SymbolicCell:
        """The watchdog, which has nothing to stop."""
        return self

    def beat(self, who: object, now: float) -> bool:
        """Receive a heartbeat, in time whenever it comes."""
        return True

    def retire(self, who: object) -> None:
        """Expect no further heartbeats of a client."""

    def is_at_rest(self, devices: Collection[str] | None = None) -> bool:
        """Whether devices are at rest: always, since there are none."""
        return True

    def advance(self, seconds: float) -> None:
        """Let time pass, in s."""
        self.now += seconds

    def publish(self) -> None:
        """Do nothing: no device reports anything."""

    def close(self) -> None:
        """Do nothing: there is nothing to give back."""

    def advance_period(self) -> None:
        """Do nothing: there is no control period."""

    def secure(self, devices: Collection[str] | None = None) -> Sequence[str]:
        """Return what had to be corrected: nothing, since nothing moves."""
        return ()

    def save(self) -> bytes:
        """Return the time, which is all that the cell has beside the world model."""
        return _TIME.pack(self.now)

    def save_reported(self) -> bytes:
        """Return the time: no device reports anything."""
        return self.save()

    def arm(self, individual: str) -> NoReturn:
        """Raise NoSuchDevice."""
        self._refuse("arm", individual)

    def find_standing_joints(self, individual: str) -> Array | None:
        """Raise NoSuchDevice."""
        self._refuse("arm", individual)

    def gripper(self, individual: str) -> NoReturn:
        """Raise NoSuchDevice."""
        self._refuse("gripper", individual)

    def base(self, individual: str) -> NoReturn:
        """Raise NoSuchDevice."""
        self._refuse("mobile base", individual)

    def pose_camera(self, individual: str) -> NoReturn:
        """Raise NoSuchDevice."""
        self._refuse("camera", individual)

    def camera(self) -> NoReturn:
        """Raise NoSuchDevice."""
        self._refuse("camera that inspects surfaces", "")

    def button(self, individual: str) -> NoReturn:
        """Raise NoSuchDevice."""
        self._refuse("button", individual)

    def io_point(self, individual: str) -> NoReturn:
        """Raise NoSuchDevice."""
        self._refuse("I/O point", individual)

    def _refuse(self, kind: str, individual: str) -> NoReturn:
        name = self._world.snapshot().vocabulary.short(individual) if individual else ""
        raise NoSuchDevice(f"a symbolic cell has no devices, and so no {kind} {name}".rstrip())


def _weigh_evidence(changes: Sequence[Change], stated: Evidence) -> Evidence:
    """Let nothing count as sensed or reported where there is nothing to sense."""
    return stated if stated == "assumed" else "idealised"


def _read_time(saved: bytes) -> float:
    try:
        (time_s,) = _TIME.unpack(saved)
    except struct.error as error:
        raise CheckpointError(f"it is not what a symbolic cell has saved: {error}") from error
    return float(time_s)
