"""Checks holes and patches: they lie flat on their surface, and holes are aligned with its axes."""

from __future__ import annotations

from collections.abc import Iterator
from math import acos, atan2, degrees, pi

import msgspec

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import relative_pose
from skillc_runtime.world.state.terms import HAS_HOLE, HAS_PATCH, ORIENTATION, POSITION, SIZE
from skillc_runtime.world.state.world_state import WorldState

TURN_RAD = 0.02
"""Areas turned by less than this count as aligned: numbers in files are rounded."""


class _Area(msgspec.Struct, frozen=True):
    """An area and its surface, by IRI, with their sizes (2,) in m, and the pose in the surface frame."""

    area: str
    surface: str
    size: Array
    surface_size: Array
    pose: Pose

    @property
    def box(self) -> Array:
        """The size (2,) in m of the smallest rectangle along the surface's axes that contains the area."""
        return np.asarray(np.abs(self.pose.rotation[:2, :2]) @ self.size)

    @property
    def tilt(self) -> float:
        """The angle in rad between the normals."""
        return acos(float(np.clip(self.pose.rotation[2, 2], -1.0, 1.0)))

    @property
    def turn(self) -> float:
        """The angle in rad, from 0 to pi / 4, between the sides of the area and the surface's axes."""
        angle = atan2(self.pose.rotation[1, 0], self.pose.rotation[0, 0])
        return abs((angle + pi / 4) % (pi / 2) - pi / 4)

    @property
    def is_beside(self) -> bool:
        """Whether nothing of the area lies on the surface."""
        return bool((np.abs(self.pose.position[:2]) >= (self.surface_size + self.box) / 2).any())


def check_surface_regions(state: WorldState) -> Iterator[SceneViolation]:
    """Yield areas that are tilted, turned or beside their surface; areas without a known pose are left out."""
    for each in (*_areas(state, HAS_HOLE), *_areas(state, HAS_PATCH)):
        if each.tilt > TURN_RAD:
            yield _tilted(state, each)
        elif each.is_beside:
            yield _beside(state, each)
    for each in _areas(state, HAS_HOLE):
        if each.tilt <= TURN_RAD < each.turn and not each.is_beside:
            yield _turned(state, each)


def _areas(state: WorldState, relation: str) -> Iterator[_Area]:
    for surface, area in sorted(state.pairs(relation)) if relation in state.facts else ():
        size, surface_size = _size(state, area), _size(state, surface)
        try:
            pose = relative_pose(state, surface, area)
        except FrameError:
            continue
        if size is not None and surface_size is not None:
            yield _Area(area, surface, size, surface_size, pose)


def _size(state: WorldState, individual: str) -> Array | None:
    found = [value for name in SIZE[:2] if isinstance(value := state.value(individual, name), int | float)]
    return np.array(found) if len(found) == 2 else None


def _tilted(state: WorldState, each: _Area) -> SceneViolation:
    short = state.vocabulary.short
    message = f"{short(each.area)} is tilted by {degrees(each.tilt):.0f} degrees out of {short(each.surface)}"
    return _violation(state, each, ORIENTATION[0], "turned-area", message, "its z points as the surface's z does")


def _turned(state: WorldState, each: _Area) -> SceneViolation:
    short, (x, y) = state.vocabulary.short, each.box
    message = f"{short(each.area)} is turned by {degrees(each.turn):.0f} degrees on {short(each.surface)}"
    message += ", and lanes go around holes at right angles"
    cure = f"do not turn it, and write the size of the rectangle around it, {x:.3g} m by {y:.3g} m"
    return _violation(state, each, ORIENTATION[0], "turned-area", message, cure)


def _beside(state: WorldState, each: _Area) -> SceneViolation:
    short, (x, y), (u, v) = state.vocabulary.short, each.pose.position[:2], each.surface_size / 2
    message = f"{short(each.area)} lies beside {short(each.surface)}: {x:.3g} m along its x, {y:.3g} m along its y"
    cure = f"from its middle the surface reaches {u:.3g} m along x and {v:.3g} m along y, both ways"
    return _violation(state, each, POSITION[0], "area-beside-surface", message, cure)


def _violation(state: WorldState, each: _Area, predicate: str, name: str, message: str, cure: str) -> SceneViolation:
    """Return a violation at a predicate of the area's pose if it is stated, else at its class."""
    stated = predicate if state.value(each.area, predicate) is not None else None
    return SceneViolation(each.area, stated, name, message, cure)
