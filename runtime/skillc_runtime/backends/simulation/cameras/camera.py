"""A simulated camera that inspects surfaces: it takes some spots for clean or unclean that are not."""

from __future__ import annotations

from collections.abc import Mapping
from math import comb
from typing import TYPE_CHECKING

import msgspec
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.devices.sensors import Camera
from skillc_runtime.motion.coverage import CoverageMap
from skillc_runtime.motion.dirt_map import CLEAN, DIRTY, SPARED, SURE, DirtMap
from skillc_runtime.world.state.data_sheet import DataSheet, number_of, sheet_of
from skillc_runtime.world.state.facts import Evidence
from skillc_runtime.world.state.terms import INSPECTION_CAMERA, INSPECTION_SHEET, SKILLC
from skillc_runtime.world.state.world_state import WorldState

if TYPE_CHECKING:
    from skillc_runtime.vision.classify_part import ClassifiedPart

USUAL_SHEET = SKILLC + "inspection-camera-sheet"
"""The data sheet of the camera in a scene that has no inspection camera."""


NO_IMAGES = "the scene has no skillc:InspectionCamera with a skillc:ImageSheet"


class InspectionSpec(msgspec.Struct, frozen=True):
    """A camera that inspects surfaces: how it errs in each spot of an image, and how many images vote on a spot.

    miss: share of the unclean spots that it takes for clean; false_alarm: share of the clean ones it takes for unclean.
    """

    individual: str = ""
    miss: float = 0.0
    false_alarm: float = 0.0
    images: int = 1


EXACT_INSPECTION = InspectionSpec()
"""A camera without errors."""


class SimulatedCamera(Camera):
    """Knows the true coverage of each surface by IRI, which the cell updates."""

    def __init__(
        self, coverage: Mapping[str, CoverageMap], spec: InspectionSpec, seed: int, no_images: str = NO_IMAGES
    ) -> None:
        """`no_images` says why it takes no images."""
        self._coverage, self._spec, self._no_images = coverage, spec, no_images
        self._rng = rng_for(spec.individual, seed)
        self._seen: dict[str, NDArray[np.bool_]] = {}

    @property
    def evidence(self) -> Evidence:
        """Idealised: it reads the map of the simulator, with errors that are drawn."""
        return "idealised"

    def inspect(self, surface: str) -> float:
        """Return the share of the surface that is seen to be clean; KeyError if there is no such surface."""
        self._seen[surface] = self._look(self._coverage[surface].find_clean())
        return _share(self._seen[surface])

    def dirt_map(self, surface: str) -> DirtMap | None:
        """Return which spots of a surface were clean and dirty when it was last inspected."""
        if surface not in self._seen:
            return None
        mask, seen = self._coverage[surface].mask, self._seen[surface]
        state = np.full(mask.shape, SPARED, dtype=np.uint8)
        state[mask] = np.where(seen, CLEAN, DIRTY)
        wrong = max(each for each in (self._spec.miss, self._spec.false_alarm))
        tenths = SURE if wrong == 0.0 else int(10 * (1.0 - _outvoted(wrong, self._spec.images)))
        return DirtMap(mask.shape[1], mask.shape[0], state.tobytes(), bytes([tenths]) * state.size)

    def classify(self, part: str) -> ClassifiedPart:
        """Raise NoSuchDevice: without images nothing is known of parts."""
        raise NoSuchDevice(f"parts are classified by images, and none is rendered: {self._no_images}")

    def rubbed_share(self, surface: str, seconds: float) -> float:
        """Return the share that is seen to have been under a pressed tool for at least `seconds`.

        KeyError if there is no such surface.
        """
        return _share(self._look(self._coverage[surface].find_worked(seconds)))

    def _look(self, done: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Return which spots (n,) most of the images show as done, of which `done` (n,) really are."""
        spec = self._spec
        if spec.miss == spec.false_alarm == 0.0:
            return done
        wrong = self._rng.random((spec.images, done.size)) < np.where(done, spec.false_alarm, spec.miss)
        return np.asarray(2 * (wrong != done).sum(axis=0) > spec.images)


def _share(spots: NDArray[np.bool_]) -> float:
    return float(spots.mean()) if spots.size else 1.0


def _outvoted(wrong: float, images: int) -> float:
    """Return how likely most of so many images are wrong about a spot, each with a probability."""
    many = range(images // 2 + 1, images + 1)
    return sum(comb(images, each) * wrong**each * (1.0 - wrong) ** (images - each) for each in many)


def read_inspection_camera(state: WorldState) -> InspectionSpec:
    """Read the first inspection camera in order of IRI, or the usual one; SheetError if a fact is missing."""
    found = sorted(state.instances(INSPECTION_CAMERA)) if INSPECTION_CAMERA in state.vocabulary.classes else []
    if found:
        return _read(found[0], sheet_of(state, found[0]))
    if INSPECTION_SHEET in state.vocabulary.classes and USUAL_SHEET in state.instances(INSPECTION_SHEET):
        return _read(USUAL_SHEET, DataSheet(state, USUAL_SHEET))
    return EXACT_INSPECTION


def _read(camera: str, sheet: DataSheet) -> InspectionSpec:
    miss, false_alarm = (
        number_of(sheet.state, sheet.individual, SKILLC + name, default=0.0) for name in ("missRate", "falseAlarmRate")
    )
    return InspectionSpec(camera, miss, false_alarm, round(sheet.number("imagesPerInspection")))
