"""What a back end may offer besides running its devices: simulations all of it, real cells little."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

import msgspec

if TYPE_CHECKING:
    from skillc_runtime.devices.checkpoints import Checkpoints
    from skillc_runtime.devices.command_record import CommandRecord
    from skillc_runtime.devices.disturbances import Disturber
    from skillc_runtime.devices.drawing import Drawing
    from skillc_runtime.devices.ground_truth import GroundTruth
    from skillc_runtime.devices.live import LiveSignals
    from skillc_runtime.devices.observed import CellObserver


class Judge(Protocol):
    """Knows the truth of a cell, and judges by it what the world model claims."""

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


class LockStep(Protocol):
    """A cell whose time passes only in calls: between them nothing moves, for however long."""

    def advance_period(self) -> None:
        """Run one control period; ControlError or BackendBroken as `advance`, but the world model is not written."""
        ...


class BackendCapabilities(msgspec.Struct, frozen=True):
    """What a back end offers; whoever needs what is None does without, or says so.

    lock_step: time stands still between calls, so that a run can be repeated. judge: claims are judged, and what
    falls is waited for. truth: for reports and trials. drawing: for films and displays. disturber: things happen to
    the cell that no skill does. checkpoints: the cell can be built again as it was. live: signals in each control
    period. observer: looks at real devices, beside what the scene says. commands: nothing
    is sent to devices, but what would be is kept. imperfect: devices are as far from ideal as facts say. symbolic: its
    body is the world model, and nothing in it has a pose, so that time passes from one event to the next.
    """

    lock_step: LockStep | None = None
    judge: Judge | None = None
    truth: GroundTruth | None = None
    drawing: Drawing | None = None
    disturber: Disturber | None = None
    checkpoints: Checkpoints | None = None
    live: LiveSignals | None = None
    observer: CellObserver | None = None
    commands: CommandRecord | None = None
    imperfect: bool = False
    symbolic: bool = False


NO_CAPABILITIES = BackendCapabilities()
