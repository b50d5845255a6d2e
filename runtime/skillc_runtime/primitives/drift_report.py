"""Writes how fast a force sensor was found to drift."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import SENSOR_DRIFT

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell

LEAST_N_S: Final = 0.005
"""Less cannot be distinguished from noise, and is not written."""


def report_drift(cell: Cell, arm: str, origin: str) -> None:
    """Write the drift of an arm's sensor as it was found by its last tares, if it is more than noise."""
    found = cell.arm(arm).compliance.force_drift
    if found >= LEAST_N_S:
        cell.world.commit([SetProperty(arm, SENSOR_DRIFT, round(found, 4))], origin, "reported")
