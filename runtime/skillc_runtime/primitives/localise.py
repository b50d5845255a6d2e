"""Noting where a surface really is, after a tool was laid flush on it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.world.space.frames import placed, pose
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import LOCATED

if TYPE_CHECKING:
    from skillc_runtime.world.state.model import WorldModel


def localise(world: WorldModel, surface: str, tool: Pose) -> None:
    """Write the pose of a surface on which a tool, at `tool` in the world, lies flush."""
    found = touched(pose(world.snapshot(), surface), tool)
    world.commit([*placed(surface, found), SetProperty(surface, LOCATED, True)], "Align", "sensed")


def touched(believed: Pose, tool: Pose) -> Pose:
    """Return where a surface is whose believed pose is corrected by a tool lying on it.

    Its plane goes through the tool centre point, its normal is opposite to the tool's z. What touching cannot tell, the
    place within the plane and the turn about the normal, stays as believed.
    """
    normal = -tool.rotation[:, 2]
    rotation = _turn(believed.rotation[:, 2], normal) @ believed.rotation
    away = float(normal @ (tool.position - believed.position))
    return Pose(believed.position + away * normal, rotation)


def _turn(start: Array, end: Array) -> Array:
    """Return the smallest rotation (3, 3) that turns one unit vector into another, not opposite, one."""
    axis = np.cross(start, end)
    sine = float(np.linalg.norm(axis))
    return exp(axis / sine * np.arctan2(sine, float(start @ end))) if sine > 1e-12 else np.eye(3)
