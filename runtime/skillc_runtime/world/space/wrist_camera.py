"""A camera on the flange of an arm: where it is at given joints, and from where it sees all of a thing."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import msgspec
import mujoco
import numpy as np

from skillc_runtime.kinematics.chain import Chain, read_chain
from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.vision.inspected_surface import Markers
from skillc_runtime.vision.lens import Lens
from skillc_runtime.world.space.frame_tree import frame_tree_of
from skillc_runtime.world.space.frames import pose, size
from skillc_runtime.world.space.image_facts import MARKER_SIZE, read_lens
from skillc_runtime.world.space.part_looks import face_of
from skillc_runtime.world.state.data_sheet import number_of, sheet_of
from skillc_runtime.world.state.terms import HAS_SENSOR, IMAGE_SHEET, INSPECTION_CAMERA, SURFACE
from skillc_runtime.world.state.world_state import WorldState

FLANGE = "flange"
"""The site at the flange in the MJCF of an arm."""

MISPLACED_M = 0.02
"""By how much a thing is seen beside its edges, as it may be elsewhere than it is believed to be."""

USED_SHARE = 0.9
"""Share of an image within which a thing is to be, as an arm does not come exactly to where it goes."""

NEAREST_M = 0.25
"""How near a camera goes to what it looks at: the hand beside it is as long."""

TILTS_RAD, TURNS, AWAY = (0.0, 0.3), 12, (1.0, 1.2)
"""How far from straight above a camera looks, in how many directions and turns, and how many times as far away."""


class WristCamera(msgspec.Struct, frozen=True):
    """A camera that takes images, on the flange of an arm: its IRI, its pose there, its lens."""

    individual: str
    on_flange: Pose
    lens: Lens


def find_wrist_camera(state: WorldState, arm: str) -> WristCamera | None:
    """Return the first inspection camera on an arm's flange that takes images, None if it has none.

    Its pose, without a BaseFrameId, is in the flange. SheetError or MissingFact if a number is missing.
    """
    for each in sorted(state.objects(arm, HAS_SENSOR)):
        if state.is_a(each, INSPECTION_CAMERA):
            sheet = sheet_of(state, each)
            if state.is_a(sheet.individual, IMAGE_SHEET):
                return WristCamera(each, frame_tree_of(state).own_pose(each), read_lens(sheet))
    return None


def read_flange(state: WorldState, arm: str) -> Chain:
    """Return the joints of an arm from its base to its flange, by its own model; SheetError if it has none."""
    return _read_flange(str(sheet_of(state, arm).model))


@lru_cache(maxsize=16)
def _read_flange(model: str) -> Chain:
    return read_chain(mujoco.MjModel.from_xml_path(model), FLANGE)


def list_viewpoints(state: WorldState, thing: str, lens: Lens) -> Iterator[tuple[Pose, ...]]:
    """Yield poses in the world of a camera that sees all of a thing, the best first; those together are as good.

    Of a surface it sees the markers as well, of another thing the upper face. FrameError if its pose or size is
    missing.
    """
    face, points = _seen_part(state, thing)
    for tilt in TILTS_RAD:
        for away in AWAY:
            for side in range(1 if tilt == 0.0 else TURNS // 2):
                lean = 4 * np.pi * side / TURNS
                tilted = exp(tilt * np.array([np.cos(lean), np.sin(lean), 0.0])) @ np.diag([1.0, -1.0, -1.0])
                turns = (2 * np.pi * each / TURNS for each in range(TURNS))
                yield tuple(face @ _viewpoint(points, tilted @ _turned(each), lens, away) for each in turns)


def _turned(turn: float) -> Array:
    return exp(np.array([0.0, 0.0, turn]))


def _viewpoint(points: Array, rotation: Array, lens: Lens, away: float) -> Pose:
    """Return the pose of a camera with a rotation that sees points (n, 3), all in m in one frame, from nearby.

    A point at x, z beside and along the optical axis of a camera at 0 is at fx x / (z + d) if it goes back by d.
    """
    inside = points @ rotation
    half = USED_SHARE * np.array([min(lens.cx, lens.width - 1 - lens.cx), min(lens.cy, lens.height - 1 - lens.cy)])
    least = np.abs(inside[:, :2]) * np.array([lens.fx, lens.fy]) / half - inside[:, 2:]
    return Pose(-away * max(float(least.max()), NEAREST_M) * rotation[:, 2], rotation)


def _seen_part(state: WorldState, thing: str) -> tuple[Pose, Array]:
    """Return a plane in the world, and the corners (4, 3) in m in it of what is to be seen."""
    extent = size(state, thing)[:2] / 2 + MISPLACED_M
    if not state.is_a(thing, SURFACE):
        return face_of(state, thing), _corners(extent)
    if MARKER_SIZE in state.stored and state.value(thing, MARKER_SIZE) is not None:
        extent[0] += Markers(number_of(state, thing, MARKER_SIZE)).plate_m
    return pose(state, thing), _corners(extent)


def _corners(half: Array) -> Array:
    return np.array([(x * half[0], y * half[1], 0.0) for x in (-1.0, 1.0) for y in (-1.0, 1.0)])
