"""The interface of what owns the time of a cell: a simulation in lock step, or devices with a control thread."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, Protocol, runtime_checkable

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell


class BackendBroken(RuntimeError):
    """A cell can never move again; the message says why."""


@dataclass(frozen=True, slots=True)
class DeviceStop:
    """Why devices have stopped by themselves, and may not move before somebody has acknowledged that."""

    kind: Literal["protective-stop", "emergency-stop"]
    reason: str


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


class Clock(Protocol):
    """The clock of a cell."""

    @property
    def now(self) -> float:
        """The time in s since the cell started; simulated time in simulation."""
        ...


class Backend(Protocol):
    """Owns the time of a cell. In lock step time passes only in `advance`; with a control thread `advance` waits.

    Devices are arms, grippers and bases, by IRI; None stands for all of the cell.
    """

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
        ...

    @property
    def stops(self) -> DeviceStops:
        """Why devices have stopped by themselves."""
        ...

    def is_at_rest(self, devices: Collection[str] | None = None) -> bool:
        """Whether devices neither move nor push; true of a broken cell, whose time stands still."""
        ...

    def advance(self, seconds: float) -> None:
        """Let time pass, in s. BackendBroken if the cell breaks or has broken; other errors of its controllers."""
        ...

    def secure(self, devices: Collection[str] | None = None) -> Sequence[str]:
        """Stop devices, release all their forces and make arms stiff; return what had to be corrected."""
        ...

    def close(self) -> None:
        """End the threads of the backend; idempotent."""
        ...


@runtime_checkable
class Judge(Protocol):
    """What a backend can do besides that knows the truth of its cell, as a simulation does."""

    @property
    def has_physics(self) -> bool:
        """Whether it computes contact and weight, so that what idealised devices read of them counts as verified."""
        ...

    @property
    def things_lie_still(self) -> bool:
        """Whether nothing that no hand holds falls, rolls, tips or slides."""
        ...

    def find_false_claims(self) -> tuple[str, ...]:
        """Return what the world model claims of what is where, and who holds what, that is not so; a sentence each."""
        ...


@runtime_checkable
class LockStep(Protocol):
    """A backend whose time passes only in calls: between them nothing moves, for however long."""

    def advance_period(self) -> None:
        """Run one control period; ControlError or BackendBroken as `advance`, but the world model is not written."""
        ...
