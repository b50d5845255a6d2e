"""The obstacles around an arm in the world model, as plain values in the arm's base frame."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from skillc_runtime.motion.pose import Pose, quaternion_from_rotation
from skillc_runtime.world.space.bounding_boxes import solid_box
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.terms import FIXTURE, SIZE, WORKSPACE
from skillc_runtime.world.state.world_state import WorldState

FAR_M = 3.0
"""Objects at a greater distance from an arm's base are left out."""

Numbers: TypeAlias = tuple[float, ...]


@dataclass(frozen=True, slots=True)
class PoseKey:
    """A pose as hashable numbers: position in m, unit quaternion (w, x, y, z)."""

    position: Numbers
    quaternion: Numbers


@dataclass(frozen=True, slots=True)
class BoxObstacle:
    """A box: its short name, the pose of its centre, half its size in m."""

    name: str
    place: PoseKey
    half: Numbers


@dataclass(frozen=True, slots=True)
class ModelObstacle:
    """An object with its own model: its short name, its pose, the path of its MJCF."""

    name: str
    place: PoseKey
    model: str


@dataclass(frozen=True, slots=True)
class Scenery:
    """The obstacles in order of IRI, and the floor, in the plane of the map frame."""

    floor: PoseKey
    blocks: tuple[BoxObstacle, ...]
    modelled: tuple[ModelObstacle, ...]


def pose_key(pose: Pose) -> PoseKey:
    """Return a pose as numbers, rounded to 1 um and 1 urad so that equal poses compare equal."""
    quaternion = quaternion_from_rotation(pose.rotation)
    return PoseKey(tuple(np.round(pose.position, 6).tolist()), tuple(np.round(quaternion, 6).tolist()))


def read_scenery(state: WorldState, base: Pose) -> Scenery:
    """Return all objects with a pose and a size or a model around an arm with its base at `base` in the world.

    Objects that an arm holds have no pose in the world; a workspace is not an obstacle.
    """
    inward = base.inverse()
    return Scenery(pose_key(inward), tuple(_blocks(state, inward)), tuple(_modelled(state, inward)))


def _blocks(state: WorldState, inward: Pose) -> Iterator[BoxObstacle]:
    sized = state.stored.get(SIZE[0])
    for individual in sorted(each for each, _ in sized.items()) if sized else ():
        if state.is_a(individual, WORKSPACE) or state.is_a(individual, FIXTURE):
            continue
        with suppress(FrameError):
            box = solid_box(state, individual)
            middle = inward @ box.middle
            if np.linalg.norm(middle.position) - np.linalg.norm(box.half) < FAR_M:
                yield BoxObstacle(state.vocabulary.short(individual), pose_key(middle), tuple(box.half.tolist()))


def _modelled(state: WorldState, inward: Pose) -> Iterator[ModelObstacle]:
    for individual in sorted(state.instances(FIXTURE)):
        with suppress(FrameError, SheetError):
            path = sheet_of(state, individual).model
            middle = inward @ pose(state, individual)
            if np.linalg.norm(middle.position) < FAR_M:
                yield ModelObstacle(state.vocabulary.short(individual), pose_key(middle), str(path))
