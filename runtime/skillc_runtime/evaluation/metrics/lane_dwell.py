"""How long a wiping tool lingers where lanes turn."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Literal, TypeAlias

import numpy as np

from skillc_runtime.devices.ground_truth import Recording
from skillc_runtime.motion.pose import Array

LINGERING = 0.5
"""Share of the lane speed below which a tool lingers."""

OVERLAID_M_S = 1e-3
"""An overlay that moves faster than this at some time hides how fast the tool goes along the lanes."""

STANDING = 0.05
"""Share of the lane speed below which a path has no direction."""

Follower: TypeAlias = Literal["tool", "path"]
"""Whose speed is looked at: what the tool did, or what it was asked for, without the overlay that hides what it did."""


@dataclass(frozen=True, slots=True)
class LaneDwell:
    """The time lost at each corner of a quarter turn, s, and whose it is."""

    seconds: float
    of: Follower


def lane_dwell(window: Recording) -> LaneDwell | None:
    """Return the time below half the lane speed, without start and end, for each inner corner; None without corners.

    The lane speed is the greatest of the path; turning round counts as two corners, a half circle too.
    """
    velocity, of = along_lanes(window)
    paths = np.linalg.norm(window.path_velocity, axis=1)
    lane_speed = float(paths.max(initial=0.0))
    corners = round(_turned(window.path_velocity[paths > STANDING * lane_speed]) / (pi / 2))
    fast = np.flatnonzero(np.linalg.norm(velocity, axis=1) >= LINGERING * lane_speed)
    if corners == 0 or fast.size == 0:
        return None
    lingering = fast[-1] - fast[0] + 1 - fast.size
    return LaneDwell(float(lingering * (window.time[1] - window.time[0]) / corners), of)


def along_lanes(window: Recording) -> tuple[Array, Follower]:
    """Return the velocity (n, 3) along the lanes: of the tool, or of the path where an overlay is added to it."""
    overlay = np.abs(window.reference_velocity - window.path_velocity).max(initial=0.0)
    return (window.path_velocity, "path") if overlay > OVERLAID_M_S else (window.velocity, "tool")


def _turned(velocity: Array) -> float:
    """Return the sum of all turns of a path in rad, however it turns; velocity (n, 3) is never 0."""
    direction = velocity / np.linalg.norm(velocity, axis=1, keepdims=True)
    cosine = np.einsum("ij,ij->i", direction[1:], direction[:-1])
    sine = np.linalg.norm(np.cross(direction[1:], direction[:-1]), axis=1)
    return float(np.arctan2(sine, cosine).sum())
