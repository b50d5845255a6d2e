"""Cells: how they are, how fast their time may pass, who alone commands them, and what happens to simulated ones."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

import msgspec

from skillc_runtime.devices.disturbances import Disturbance as Disturbance
from skillc_runtime.execution.pace import SLOWEST

CellState: TypeAlias = Literal["off", "operational", "protective-stop", "fault", "emergency-stop"]
"""`off`: its process does not run. `operational`: it takes operations. In the other states it takes none until the
cause is removed and that is acknowledged: `protective-stop` after a device has stopped by itself, because of a limit,
an implausible measurement, or because it does not answer; `fault` if the cell cannot go on, for example because the
disk is full; `emergency-stop` after a device has reported one."""


class CellStatus(msgspec.Struct, frozen=True, kw_only=True):
    """A cell as it is now; `reason` is why it is in its state.

    `library_hash` identifies the library that its next operation runs; `library_problem` is why that is not the one on
    disk. `pace` is None for as fast as it computes; that of a `paceable` cell can be set. A `resettable` cell can be
    reset to its scene, saved and restored.
    `resets` counts the resets and restores since its process was started; what was seen before the last one is past.
    """

    name: str
    scene: str
    library: str
    library_hash: str
    library_problem: str = ""
    backend: str
    state: CellState = "operational"
    reason: str = ""
    pace: float | None = None
    paceable: bool = False
    resettable: bool = False
    resets: int = 0


class ResetReason(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The reason for a reset or a restore, for the history of the world."""

    why: Annotated[str, msgspec.Meta(max_length=500)] = ""


class CheckpointName(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The name of a new checkpoint: letters, digits, `_`, `-` and `.`."""

    name: Annotated[str, msgspec.Meta(pattern=r"^[A-Za-z0-9_][A-Za-z0-9_.-]*$", max_length=100)]


class CellCheckpoint(msgspec.Struct, frozen=True, kw_only=True):
    """A simulated cell as `who` has saved it, at the wall time `saved_ns` in ns since 1970.

    Only a cell with the same scene, library, back end and seed can be restored from it. `scene` is the name of its
    file, with a digest of the content.
    """

    name: str
    who: str
    saved_ns: int
    scene: str
    library_hash: str
    backend: str
    seed: int


MAX_PACE = 1000.0


class PaceSetting(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """How fast the cell's time may pass: `factor` times real time; null for as fast as it computes."""

    factor: Annotated[float, msgspec.Meta(ge=SLOWEST, le=MAX_PACE)] | None


class Lease(msgspec.Struct, frozen=True):
    """The lease of a cell: who has it, and for how long yet, in s of wall time; nobody if `owner` is None."""

    cell: str
    owner: str | None
    remaining_s: float


MAX_LEASE_S = 3600.0


class LeaseRequest(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """For how long a client wants to command a cell alone, in s; `takeover` ends the lease of another client."""

    duration_s: Annotated[float, msgspec.Meta(gt=0.0, le=MAX_LEASE_S)] = 60.0
    takeover: bool = False
