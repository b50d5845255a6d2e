"""Reads what images need to know: the lens of a camera, and the markers of a surface."""

from __future__ import annotations

from skillc_runtime.motion.arrays import np
from skillc_runtime.vision.inspected_surface import InspectedSurface, Markers
from skillc_runtime.vision.lens import Lens
from skillc_runtime.world.space.frames import size
from skillc_runtime.world.state.data_sheet import DataSheet, number_of
from skillc_runtime.world.state.terms import SKILLC
from skillc_runtime.world.state.world_state import WorldState

MARKER_SIZE, FIRST_MARKER = SKILLC + "markerSize", SKILLC + "firstMarker"


def read_lens(sheet: DataSheet) -> Lens:
    """Return the lens of the sheet of a camera that takes images; SheetError if a number is missing."""
    width, height = (round(sheet.number(name)) for name in ("imageWidth", "imageHeight"))
    focal = sheet.number("focalPixels")
    return Lens(width, height, focal, focal, (width - 1) / 2, (height - 1) / 2)


def read_inspected(state: WorldState, surface: str) -> InspectedSurface:
    """Return the size and the markers of a surface; SheetError or MissingFact if one is missing."""
    first = round(number_of(state, surface, FIRST_MARKER, default=0.0))
    markers = Markers(number_of(state, surface, MARKER_SIZE), first)
    return InspectedSurface(np.array(size(state, surface)[:2]), markers=markers)
