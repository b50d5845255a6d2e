"""Cells: how they are, and how fast their time may pass."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

import msgspec

from skillc_runtime.execution.pace import SLOWEST

CellState: TypeAlias = Literal["off", "operational", "protective-stop", "fault", "emergency-stop"]
"""`off`: its process does not run. `operational`: it takes operations. In the other states it takes none until the
cause is removed and that is acknowledged: `protective-stop` after a device has stopped by itself, because of a limit,
an implausible measurement, or because it does not answer; `fault` if the cell cannot go on, for example because the
disk is full; `emergency-stop` after a device has reported one."""


class CellStatus(msgspec.Struct, frozen=True, kw_only=True):
    """A cell as it is now; `reason` is why it is in its state.

    `library_hash` identifies the library that its next operation runs; `library_problem` is why that is not the one on
    disk. `pace` is None for as fast as it computes.
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


MAX_PACE = 1000.0


class PaceSetting(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """How fast the cell's time may pass: `factor` times real time; null for as fast as it computes."""

    factor: Annotated[float, msgspec.Meta(ge=SLOWEST, le=MAX_PACE)] | None
