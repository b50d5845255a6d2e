"""What a film needs of a cell."""

from __future__ import annotations

from dataclasses import dataclass

from skillc_runtime.devices.backend import Backend, Clock
from skillc_runtime.devices.drawing import Drawing
from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.world.state.model import WorldModel


@dataclass(frozen=True, slots=True)
class FilmedCell:
    """The clock and the world model of a cell, how it is drawn, and where everything really is."""

    clock: Clock
    world: WorldModel
    drawing: Drawing
    truth: GroundTruth


def find_filmed(backend: Backend) -> FilmedCell | None:
    """Return what a film needs of a cell; None if it cannot be drawn as it really is."""
    drawing, truth = backend.capabilities.drawing, backend.capabilities.truth
    if drawing is None or truth is None:
        return None
    return FilmedCell(backend.clock, backend.cell.world, drawing, truth)
