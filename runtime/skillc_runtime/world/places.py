"""The functions of the standard library that skill texts call. Poses and paths are of the tool, in the world.

The z axis of the tool frame is the direction in which the tool points, the x axis is the direction of work.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.lanes import Direction, lane_axis
from skillc_runtime.motion.lanes import plan_lanes as lane_pattern
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.motion.strokes import plan_layout_strokes
from skillc_runtime.world.space.dirt import work_layout
from skillc_runtime.world.space.frames import normal, pose, size
from skillc_runtime.world.space.surfaces import lane_direction, surface_layout

if TYPE_CHECKING:
    from skillc_runtime.world.state.world_state import WorldState


def offset(_state: WorldState, start: Pose, by: Array) -> Pose:
    """Return a pose in the world moved by a vector (3,) m in the world."""
    return Pose(start.position + by, start.rotation)


def raised(_state: WorldState, start: Pose, height: float) -> Pose:
    """Return a pose in the world moved up by a height in m."""
    return Pose(start.position + np.array([0.0, 0.0, height]), start.rotation)


def first(_state: WorldState, path: list[Pose]) -> Pose:
    """Return the first pose of a path."""
    return path[0]


def last(_state: WorldState, path: list[Pose]) -> Pose:
    """Return the last pose of a path."""
    return path[-1]


def centre(state: WorldState, surface: str) -> Pose:
    """Return the pose of a tool in the middle of a surface, aligned with it, in the world."""
    return pose(state, surface) @ Pose(np.zeros(3), _tool_axes(size(state, surface), lane_direction(state, surface)))


def facing(state: WorldState, target: str) -> Pose:
    """Return the pose of a tool at the frame of an object, pointing against its z axis, in the world."""
    return pose(state, target) @ Pose(np.zeros(3), np.diag([1.0, -1.0, -1.0]))


def x_axis(_state: WorldState, of: Pose) -> Array:
    """Return the direction (3,), unitless, of the x axis of a pose in the world."""
    return of.rotation[:, 0].copy()


def y_axis(_state: WorldState, of: Pose) -> Array:
    """Return the direction (3,), unitless, of the y axis of a pose in the world."""
    return of.rotation[:, 1].copy()


def z_axis(_state: WorldState, of: Pose) -> Array:
    """Return the direction (3,), unitless, of the z axis of a pose in the world."""
    return of.rotation[:, 2].copy()


def lanes(state: WorldState, surface: str, tool: str, overlap: float) -> list[Pose]:
    """Return tool poses on lanes that cover a surface, in the world; `overlap` is a share of the lane width, 0 to 1."""
    frame, along = pose(state, surface), lane_direction(state, surface)
    found = lane_pattern(size(state, surface)[:2], size(state, tool)[:2], overlap, direction=along)
    return [frame @ lane for lane in found]


def strokes(state: WorldState, surface: str, tool: str, overlap: float) -> list[list[Pose]]:
    """Return tool poses along lanes that cover what is to be worked on of a surface, in strokes, in the world.

    That are its patches, else what a map of it shows dirty, else all; without its holes.

    The tool must be lifted between two strokes. `overlap` is the share of the lane width, 0 to 1. ValueError when the
    tool fits nowhere.
    """
    frame, along = pose(state, surface), lane_direction(state, surface)
    found = plan_layout_strokes(
        work_layout(state, surface), size(state, tool)[:2], overlap, Pose(np.zeros(3), np.eye(3)), along
    )
    if not found:
        short = state.vocabulary.short
        raise ValueError(f"{short(tool)} fits nowhere on {short(surface)} beside the holes that it has")
    return [[frame @ place for place in stroke] for stroke in found]


def lifted(state: WorldState, surface: str, start: Pose, height: float) -> Pose:
    """Return a pose in the world moved out of a surface by a height in m above everything that stands out of it."""
    return Pose(
        start.position + (height + surface_layout(state, surface).height) * normal(state, surface), start.rotation
    )


def landing(state: WorldState, surface: str, paths: list[list[Pose]]) -> Pose:
    """Return a tool pose well inside a surface, in the world: the middle of the path segment nearest to its centre."""
    middle = pose(state, surface).position
    segments = [segment for path in paths for segment in pairwise(path)] or [(path[0], path[0]) for path in paths]
    places = [Pose((start.position + end.position) / 2, start.rotation) for start, end in segments]
    return min(places, key=lambda place: float(np.linalg.norm(place.position - middle)))


def across(state: WorldState, surface: str) -> Array:
    """Return the direction (3,), unitless, across the lanes of a surface, in the world."""
    along = lane_axis(size(state, surface), lane_direction(state, surface))
    return pose(state, surface).rotation[:, 1 - along].copy()


def _tool_axes(extent: Array, along: Direction) -> Array:
    """Return the axes (3, 3) of the tool, unitless, in the surface frame: z into the surface, x along the lanes."""
    if lane_axis(extent, along) == 0:
        return np.diag([1.0, -1.0, -1.0])
    return np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
