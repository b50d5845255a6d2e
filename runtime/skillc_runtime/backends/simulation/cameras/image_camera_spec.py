"""The specification of a camera that takes images of surfaces and parts, read from the facts."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from skillc_runtime.motion.pose import Pose
from skillc_runtime.vision.inspected_surface import InspectedSurface
from skillc_runtime.vision.lens import Lens
from skillc_runtime.vision.part_look import PartLook
from skillc_runtime.world.space.frame_tree import frame_tree_of
from skillc_runtime.world.space.frames import arm_with_sensor, moves_with, pose, size
from skillc_runtime.world.space.image_facts import MARKER_SIZE, read_inspected, read_lens
from skillc_runtime.world.space.part_looks import read_looks
from skillc_runtime.world.state.data_sheet import SheetError, number_of, sheet_of
from skillc_runtime.world.state.terms import (
    DIRT_REMOVAL,
    IMAGE_SHEET,
    INSPECTION_CAMERA,
    MANIPULATABLE,
    MOBILE_ROBOT,
    SKILLC,
    SURFACE,
)
from skillc_runtime.world.state.world_state import WorldState

LABEL_CODE, DEFECT_RATE = (SKILLC + name for name in ("labelCode", "defectRate"))

BRIGHT_SHARE = 0.01
"""The share of an image that is bright unless the sheet states it."""


class PrintedPart(msgspec.Struct, frozen=True):
    """A part that really has a label: how good ones of its kind look, its code, and how likely it has a defect."""

    look: PartLook
    height_m: float
    code: int
    defect_rate: float


class ImageCameraSpec(msgspec.Struct, frozen=True):
    """A camera that takes images: its believed pose in the world, or on the flange of an `arm`, its lens and errors.

    It is really up to `mount_m` along and `mount_rad` about each axis from there. A pixel is full at `full_well`
    electrons and is read with a noise of `read_noise`. A lamp at it is `ring_light` times as bright as all other light
    above what is looked at; the exposure lets a share `bright_share` of an image be bright. surfaces: those with
    markers, by IRI; removal_s: for each of them, the time in s under a pressed tool in which its dirt falls to 1/e.
    parts: those with labels, by IRI.
    """

    individual: str
    arm: str | None
    pose: Pose
    lens: Lens
    mount_m: float
    mount_rad: float
    full_well: float
    read_noise: float
    ring_light: float
    bright_share: float
    surfaces: Mapping[str, InspectedSurface]
    removal_s: Mapping[str, float]
    parts: Mapping[str, PrintedPart]


def read_image_camera(state: WorldState) -> ImageCameraSpec | None:
    """Read the first inspection camera in order of IRI if it takes images, else return None.

    SheetError or FrameError if a fact is missing, or if a robot moves the camera and it is on no flange.
    """
    known = {INSPECTION_CAMERA, IMAGE_SHEET} <= set(state.vocabulary.classes)
    cameras = sorted(state.instances(INSPECTION_CAMERA)) if known else []
    sheet = sheet_of(state, cameras[0]) if cameras else None
    if sheet is None or sheet.individual not in state.instances(IMAGE_SHEET):
        return None
    arm, at = _read_place(state, cameras[0])
    marked = [each for each in sorted(state.instances(SURFACE)) if state.value(each, MARKER_SIZE) is not None]
    return ImageCameraSpec(
        individual=cameras[0],
        arm=arm,
        pose=at,
        lens=read_lens(sheet),
        mount_m=sheet.number("mountError"),
        mount_rad=sheet.number("mountTilt"),
        full_well=sheet.number("fullWell"),
        read_noise=sheet.number("readNoise"),
        ring_light=number_of(state, sheet.individual, SKILLC + "ringLight", default=0.0),
        bright_share=number_of(state, sheet.individual, SKILLC + "brightShare", default=BRIGHT_SHARE),
        surfaces={each: read_inspected(state, each) for each in marked},
        removal_s={each: number_of(state, each, DIRT_REMOVAL) for each in marked},
        parts={each: _printed(state, each) for each in _labelled(state)},
    )


def _read_place(state: WorldState, camera: str) -> tuple[str | None, Pose]:
    """Return the arm on whose flange a camera is, and its pose there, or None and its pose in the world."""
    arm = arm_with_sensor(state, camera)
    if arm is not None:
        return arm, frame_tree_of(state).own_pose(camera)
    if any(moves_with(state, camera, robot) for robot in sorted(state.instances(MOBILE_ROBOT))):
        raise SheetError(
            f"{state.vocabulary.short(camera)} moves with a robot; only cameras that stand still, or that an arm has "
            "on its flange (skillc:hasSensor), take images"
        )
    return None, pose(state, camera)


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
