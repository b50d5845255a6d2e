"""Corrects the pose of a surface with that of a tool that is flush with it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.world.space.frames import pose, relocation_changes
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import LOCATED

if TYPE_CHECKING:
    from skillc_runtime.world.state.model import WorldModel


def write_surface_pose(world: WorldModel, surface: str, tool: Pose) -> None:
    """Write the pose of a surface that a tool, with the pose `tool` in the world, is flush with."""
    state = world.snapshot()
    found = correct_pose(pose(state, surface), tool)
    world.commit([*relocation_changes(state, surface, found), SetProperty(surface, LOCATED, True)], "Align", "sensed")


def correct_pose(assumed: Pose, tool: Pose) -> Pose:
    """Return the assumed pose of a surface, corrected by the pose of a tool that is flush with it; both in the world.

    The plane passes through the tool centre point, and the normal is opposite to the tool's z axis. The position within
    the plane and the rotation about the normal, which contact does not measure, remain as assumed.
    """
    normal = -tool.rotation[:, 2]
    rotation = _smallest_rotation(assumed.rotation[:, 2], normal) @ assumed.rotation
    away = float(normal @ (tool.position - assumed.position))
    return Pose(assumed.position + away * normal, rotation)


def _smallest_rotation(start: Array, end: Array) -> Array:
    """Return the smallest rotation (3, 3) that turns one unit vector (3,) into another that is not opposite."""
    axis = np.cross(start, end)
    sine = float(np.linalg.norm(axis))
    return exp(axis / sine * np.arctan2(sine, float(start @ end))) if sine > 1e-12 else np.eye(3)
