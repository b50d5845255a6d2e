"""The data for the figure of a mobile base: its path, and what stands around it."""

from __future__ import annotations

from dataclasses import dataclass

from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.bodies import read_bodies
from skillc_runtime.world.space.shape.outlines import convex_hull, outline_points
from skillc_runtime.world.state.labels.labelled import display_name
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class DriveDrawing:
    """The path (n, 4) of a base, time in s and position in m in the world; name and outline (m, 2) of fixed bodies."""

    path: Array
    outlines: tuple[tuple[str, Array], ...]


def make_drive_drawing(path: Array, state: WorldState) -> DriveDrawing:
    """Return what is drawn of a base with a path (n, 4)."""
    bodies = (each for each in read_bodies(state) if not each.movable)
    hulls = ((each, outline_points(state, each.individual, each.pose)[:, :2]) for each in bodies)
    return DriveDrawing(path, tuple((display_name(each.individual), convex_hull(points)) for each, points in hulls))
