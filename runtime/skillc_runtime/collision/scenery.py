"""The obstacles around an arm in the world model, as plain values in the arm's base frame."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import TypeAlias

import msgspec
import numpy as np
from msgspec.structs import replace

from skillc_runtime.motion.pose import Pose, quaternion_from_rotation
from skillc_runtime.world.space.bodies import read_body
from skillc_runtime.world.space.bounding_boxes import solid_box
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.space.shape.oriented_box import OrientedBox
from skillc_runtime.world.space.shape.solids import Hull, Kind, Solid
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.terms import FIXTURE, SIZE, WORKSPACE, WORKSTATION
from skillc_runtime.world.state.world_state import WorldState

FAR_M = 3.0
"""Objects at a greater distance from an arm's base are left out."""

Numbers: TypeAlias = tuple[float, ...]


class PoseKey(msgspec.Struct, frozen=True):
    """A pose as hashable numbers: position in m, unit quaternion (w, x, y, z)."""

    position: Numbers
    quaternion: Numbers


class SolidObstacle(msgspec.Struct, frozen=True):
    """A convex solid: the short name of what it belongs to, its pose, half its size in m, and the points of a hull.

    `points` are the bytes of an array (n, 3) in m, along the axes of the solid; empty for all other kinds.
    """

    name: str
    place: PoseKey
    half: Numbers
    kind: Kind = "box"
    points: bytes = b""

    def solid_at(self, frame: Pose) -> Solid:
        """Return the solid as seen from the parent of a frame in which its pose is."""
        x, y, z = self.half
        hull = Hull(np.frombuffer(self.points).reshape(-1, 3), 0.0, np.zeros(3)) if self.points else None
        return Solid(self.kind, (x, y, z), frame @ Pose.of(self.place.position, self.place.quaternion), hull)


class ModelObstacle(msgspec.Struct, frozen=True):
    """An object with its own model: its short name, its pose, the path of its MJCF."""

    name: str
    place: PoseKey
    model: str


class Scenery(msgspec.Struct, frozen=True):
    """The obstacles in order of IRI, and the floor, in the plane of the map frame."""

    floor: PoseKey
    blocks: tuple[SolidObstacle, ...]
    modelled: tuple[ModelObstacle, ...]

    def with_blocks(self, more: tuple[SolidObstacle, ...]) -> Scenery:
        """Return the scenery with more obstacles."""
        return replace(self, blocks=(*self.blocks, *more)) if more else self


def pose_key(pose: Pose) -> PoseKey:
    """Return a pose in any frame as numbers, rounded to 1 um and 1 urad so that equal poses compare equal."""
    quaternion = quaternion_from_rotation(pose.rotation)
    return PoseKey(tuple(np.round(pose.position, 6).tolist()), tuple(np.round(quaternion, 6).tolist()))


def read_scenery(state: WorldState, base: Pose) -> Scenery:
    """Return all objects with a pose and a size or a model around an arm with its base at `base` in the world.

    Objects that an arm holds have no pose in the world; a workspace is not an obstacle.
    """
    inward = base.inverse()
    return Scenery(pose_key(inward), tuple(_blocks(state, inward)), tuple(_modelled(state, inward)))


def make_obstacles(name: str, solids: Iterable[Solid], frame: Pose) -> Iterator[SolidObstacle]:
    """Yield the obstacles that solids of a thing are whose frame is at a pose."""
    for each in solids:
        points = b"" if each.hull is None else each.hull.points.tobytes()
        yield SolidObstacle(name, pose_key(frame @ each.place), each.half, each.kind, points)


def _blocks(state: WorldState, inward: Pose) -> Iterator[SolidObstacle]:
    """Yield the solids of bodies, and boxes for other things with a size."""
    sized = state.stored.get(SIZE[0])
    for individual in sorted(each for each, _ in sized.items()) if sized else ():
        if any(state.is_a(individual, cls) for cls in (WORKSPACE, WORKSTATION, FIXTURE)):
            continue
        with suppress(FrameError, SheetError):
            box = solid_box(state, individual)
            middle = inward @ box.middle
            if np.linalg.norm(middle.position) - np.linalg.norm(box.half) < FAR_M:
                yield from _obstacles(state, individual, box, inward)


def _obstacles(state: WorldState, individual: str, box: OrientedBox, inward: Pose) -> Iterator[SolidObstacle]:
    name, body = state.vocabulary.short(individual), read_body(state, individual)
    if body is None:
        yield SolidObstacle(name, pose_key(inward @ box.middle), tuple(box.half.tolist()))
    else:
        yield from make_obstacles(name, body.solids, inward @ body.pose)


def _modelled(state: WorldState, inward: Pose) -> Iterator[ModelObstacle]:
    for individual in sorted(state.instances(FIXTURE)):
        with suppress(FrameError, SheetError):
            path = sheet_of(state, individual).model
            middle = inward @ pose(state, individual)
            if np.linalg.norm(middle.position) < FAR_M:
                yield ModelObstacle(state.vocabulary.short(individual), pose_key(middle), str(path))
