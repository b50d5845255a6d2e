"""Poses and paths that skills compute: the functions of the standard library. Poses are of the tool, in the world.

The tool frame has its z axis along the direction in which the tool points and x along the direction of work.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.lanes import lanes as lane_pattern
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.frames import pose, size

if TYPE_CHECKING:
    from skillc_runtime.world.state import WorldState


def offset(_state: WorldState, start: Pose, by: Array) -> Pose:
    """Return the pose moved by a vector (3,) m of the world."""
    return Pose(start.position + by, start.rotation)


def raised(_state: WorldState, start: Pose, height: float) -> Pose:
    """Return the pose moved up by a height in m."""
    return Pose(start.position + np.array([0.0, 0.0, height]), start.rotation)


def first(_state: WorldState, path: list[Pose]) -> Pose:
    """Return the first pose of a path."""
    return path[0]


def centre(state: WorldState, surface: str) -> Pose:
    """Return the tool's pose in the middle of a surface, flush with it."""
    return pose(state, surface) @ Pose(np.zeros(3), _tool_axes(size(state, surface)))


def facing(state: WorldState, target: str) -> Pose:
    """Return the tool's pose at the frame of a thing, pointing against its z."""
    return pose(state, target) @ Pose(np.zeros(3), np.diag([1.0, -1.0, -1.0]))


def x_axis(_state: WorldState, of: Pose) -> Array:
    """Return the direction (3,) of a pose's x axis in the world."""
    return of.rotation[:, 0].copy()


def y_axis(_state: WorldState, of: Pose) -> Array:
    """Return the direction (3,) of a pose's y axis in the world."""
    return of.rotation[:, 1].copy()


def z_axis(_state: WorldState, of: Pose) -> Array:
    """Return the direction (3,) of a pose's z axis in the world."""
    return of.rotation[:, 2].copy()


def lanes(state: WorldState, surface: str, tool: str, overlap: float) -> list[Pose]:
    """Return the tool's poses along lanes that cover a surface; `overlap`: the share neighbours have in common."""
    frame = pose(state, surface)
    return [frame @ lane for lane in lane_pattern(size(state, surface)[:2], size(state, tool)[:2], overlap)]


def across(state: WorldState, surface: str) -> Array:
    """Return the direction (3,) of the world across the lanes of a surface."""
    extent = size(state, surface)
    return pose(state, surface).rotation[:, 1 if extent[0] >= extent[1] else 0].copy()


def _tool_axes(extent: Array) -> Array:
    """Return the tool's axes (3, 3) in the surface frame: z into the surface, x along the longer side."""
    if extent[0] >= extent[1]:
        return np.diag([1.0, -1.0, -1.0])
    return np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
