"""The specification of a camera that takes images of surfaces and parts, read from the facts."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from skillc_runtime.motion.pose import Pose
from skillc_runtime.vision.inspected_surface import InspectedSurface
from skillc_runtime.vision.lens import Lens
from skillc_runtime.vision.part_look import PartLook
from skillc_runtime.world.space.frames import moves_with, pose, size
from skillc_runtime.world.space.image_facts import MARKER_SIZE, read_inspected, read_lens
from skillc_runtime.world.space.part_looks import read_looks
from skillc_runtime.world.state.data_sheet import SheetError, number_of, sheet_of
from skillc_runtime.world.state.terms import (
    IMAGE_SHEET,
    INSPECTION_CAMERA,
    MANIPULATABLE,
    MOBILE_ROBOT,
    SKILLC,
    SURFACE,
)
from skillc_runtime.world.state.world_state import WorldState

DIRT_REMOVAL, LABEL_CODE, DEFECT_RATE = (SKILLC + name for name in ("dirtRemoval", "labelCode", "defectRate"))


class PrintedPart(msgspec.Struct, frozen=True):
    """A part that really has a label: how good ones of its kind look, its code, and how likely it has a defect."""

    look: PartLook
    height_m: float
    code: int
    defect_rate: float


class ImageCameraSpec(msgspec.Struct, frozen=True):
    """A camera that stands still and takes images: its believed pose in the world, lens and errors.

    It is really up to `mount_m` along and `mount_rad` about each axis from there. A pixel is full at `full_well`
    electrons and is read with a noise of `read_noise`. A lamp at it is `ring_light` times as bright as all other light
    above what is looked at. surfaces: those with markers, by IRI; removal_s: for each of
    them, the time in s under a pressed tool in which its dirt falls to 1/e. parts: those with labels, by IRI.
    """

    individual: str
    pose: Pose
    lens: Lens
    mount_m: float
    mount_rad: float
    full_well: float
    read_noise: float
    ring_light: float
    surfaces: Mapping[str, InspectedSurface]
    removal_s: Mapping[str, float]
    parts: Mapping[str, PrintedPart]


def read_image_camera(state: WorldState) -> ImageCameraSpec | None:
    """Read the first inspection camera in order of IRI if it takes images, else return None.

    SheetError or FrameError if a fact is missing, or if a robot moves the camera.
    """
    known = {INSPECTION_CAMERA, IMAGE_SHEET} <= set(state.vocabulary.classes)
    cameras = sorted(state.instances(INSPECTION_CAMERA)) if known else []
    sheet = sheet_of(state, cameras[0]) if cameras else None
    if sheet is None or sheet.individual not in state.instances(IMAGE_SHEET):
        return None
    short = state.vocabulary.short
    if any(moves_with(state, cameras[0], robot) for robot in sorted(state.instances(MOBILE_ROBOT))):
        raise SheetError(f"{short(cameras[0])} moves with a robot; only cameras that stand still take images")
    marked = [each for each in sorted(state.instances(SURFACE)) if state.value(each, MARKER_SIZE) is not None]
    return ImageCameraSpec(
        individual=cameras[0],
        pose=pose(state, cameras[0]),
        lens=read_lens(sheet),
        mount_m=sheet.number("mountError"),
        mount_rad=sheet.number("mountTilt"),
        full_well=sheet.number("fullWell"),
        read_noise=sheet.number("readNoise"),
        ring_light=number_of(state, sheet.individual, SKILLC + "ringLight", default=0.0),
        surfaces={each: read_inspected(state, each) for each in marked},
        removal_s={each: number_of(state, each, DIRT_REMOVAL) for each in marked},
        parts={each: _printed(state, each) for each in _labelled(state)},
    )


def _labelled(state: WorldState) -> list[str]:
    return sorted(each for each in state.instances(MANIPULATABLE) if state.value(each, LABEL_CODE) is not None)


def _printed(state: WorldState, part: str) -> PrintedPart:
    code = round(number_of(state, part, LABEL_CODE))
    look = next((each for each in read_looks(state, part) if each.codes[0] <= code <= each.codes[1]), None)
    if look is None:
        raise SheetError(
            f"{state.vocabulary.short(part)} has a label with the code {code}, which no skillc:PartKind has"
        )
    rate = number_of(state, part, DEFECT_RATE, default=0.0)
    return PrintedPart(look, float(size(state, part)[2]), code, rate)
