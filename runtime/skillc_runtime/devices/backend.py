"""The interface of what owns the time of a cell: a simulation in lock step, or devices with a control thread."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from typing import TYPE_CHECKING, Literal, Protocol

import msgspec

from skillc_runtime.devices.capabilities import NO_CAPABILITIES, BackendCapabilities

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell
    from skillc_runtime.world.state.model import WorldModel


class BackendBroken(RuntimeError):
    """A cell can never move again; the message says why."""


class BackendUnavailable(Exception):
    """A cell cannot be made, because a device does not answer or a program is missing; the message says what to do."""


class DeviceStop(msgspec.Struct, frozen=True):
    """Why devices have stopped by themselves, and may not move before somebody has acknowledged that.

    `devices` are the IRIs of those that report it; none if it concerns the cell as a whole.
    """

    kind: Literal["protective-stop", "emergency-stop"]
    reason: str
    devices: tuple[str, ...] = ()


def find_first_stop(faults: Iterable[tuple[str, str | None]]) -> DeviceStop | None:
    """Return the stop of the first device, by IRI, with a reason; None if none has one."""
    return next((DeviceStop("protective-stop", why, (device,)) for device, why in faults if why is not None), None)


class StopPersists(Exception):
    """Devices may not move yet, because the cause of their stop is still there; the message says what to do."""


class DeviceStops(Protocol):
    """The stops that devices report."""

    @property
    def report(self) -> DeviceStop | None:
        """The worst stop that was reported and not cleared, or whose cause is still there; None for none."""
        ...

    def clear(self) -> None:
        """Forget the stops, because somebody has acknowledged them; StopPersists, and nothing has changed."""
        ...


class NoStops:
    """Devices that never stop by themselves; implements `DeviceStops`."""

    report: DeviceStop | None = None

    def clear(self) -> None:
        """Do nothing."""


NO_STOPS = NoStops()


class Clock(Protocol):
    """The clock of a cell."""

    @property
    def now(self) -> float:
        """The time in s since the cell started; simulated time in simulation."""
        ...


class Backend(Protocol):
    """Owns the time of a cell. In lock step time passes only in `advance`; with a control thread `advance` waits.

    Devices are arms, grippers and bases, by IRI; None stands for all of the cell. A class that is derived from this
    one has what is implemented here; another one needs all of it.
    """

    @property
    def capabilities(self) -> BackendCapabilities:
        """What it offers besides, always the same; nothing."""
        return NO_CAPABILITIES

    @property
    def cell(self) -> Cell:
        """The cell as skills see it."""
        ...

    @property
    def clock(self) -> Clock:
        """The clock of the cell."""
        ...

    @property
    def broken(self) -> str | None:
        """Why the cell cannot go on, for example because the simulation diverged; None while it can."""
        return None

    @property
    def stops(self) -> DeviceStops:
        """Why devices have stopped by themselves."""
        return NO_STOPS

    def is_at_rest(self, devices: Collection[str] | None = None) -> bool:
        """Whether devices neither move nor push; true of a broken cell, whose time stands still."""
        ...

    def advance(self, seconds: float) -> None:
        """Let `seconds` pass, in s. BackendBroken if the cell breaks or has broken; other errors of its controllers."""
        ...

    def publish(self) -> None:
        """Write to the world model what devices have reported; `advance` does that as well, while time passes."""

    def secure(self, devices: Collection[str] | None = None) -> Sequence[str]:
        """Stop devices, release all their forces and make arms stiff; return what had to be corrected."""
        ...

    def close(self) -> None:
        """End the threads of the backend, and give its devices back; idempotent."""


class BackendStart(msgspec.Struct, frozen=True):
    """How a cell begins: the seed by which a simulation differs from the facts, and what was saved, None for nothing.

    Only what its `checkpoints` have saved is given to a back end. A cell that is only `observed` takes nothing under
    control, sends nothing by which anything moves, and offers none of its devices, but their `observer`.
    """

    seed: int = 0
    saved: bytes | None = None
    observed: bool = False


class MakeBackend(Protocol):
    """Builds a cell from the facts of a world model: what an entry point of the group `skillc.backends` names."""

    def __call__(self, world: WorldModel, start: BackendStart) -> Backend:
        """Return the cell, at rest.

        SheetError or FrameError if facts are missing or contradict each other, CheckpointError if what was saved cannot
        be read, BackendUnavailable if a device or a program is missing.
        """
        ...
