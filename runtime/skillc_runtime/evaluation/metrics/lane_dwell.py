"""The dwell of a wiping tool: the time that it loses where lanes turn."""

from __future__ import annotations

from math import pi
from typing import Literal, TypeAlias

import msgspec
import numpy as np

from skillc_runtime.devices.ground_truth import Recording
from skillc_runtime.motion.pose import Array

DWELL_SHARE = 0.5
"""Share of the lane speed below which a tool dwells."""

OVERLAY_M_S = 1e-3
"""An overlay that exceeds this speed at some time hides the speed of the tool along the lanes."""

STANDSTILL_SHARE = 0.05
"""Share of the lane speed below which a path has no direction."""

DwellSource: TypeAlias = Literal["tool", "path"]
"""Whose speed is measured: the tool's, or that of the commanded path, if an overlay hides the tool's."""


class LaneDwell(msgspec.Struct, frozen=True):
    """The time in s lost at each corner of a quarter turn, and whose it is."""

    seconds: float
    of: DwellSource


def measure_lane_dwell(window: Recording) -> LaneDwell | None:
    """Return the time below half the lane speed for each inner corner, without start and end; None without corners.

    The lane speed is the greatest speed of the path; a U-turn or a half circle counts as two corners.
    """
    velocity, of = find_lane_velocity(window)
    paths = np.linalg.norm(window.path_velocity, axis=1)
    lane_speed = float(paths.max(initial=0.0))
    corners = round(_total_turn_rad(window.path_velocity[paths > STANDSTILL_SHARE * lane_speed]) / (pi / 2))
    fast = np.flatnonzero(np.linalg.norm(velocity, axis=1) >= DWELL_SHARE * lane_speed)
    if corners == 0 or fast.size == 0:
        return None
    dwelling = fast[-1] - fast[0] + 1 - fast.size
    return LaneDwell(float(dwelling * (window.time[1] - window.time[0]) / corners), of)


def find_lane_velocity(window: Recording) -> tuple[Array, DwellSource]:
    """Return the velocity (n, 3) in m/s along the lanes: of the tool, or of the path if it has an overlay."""
    overlay = np.abs(window.reference_velocity - window.path_velocity).max(initial=0.0)
    return (window.path_velocity, "path") if overlay > OVERLAY_M_S else (window.velocity, "tool")


def _total_turn_rad(velocity: Array) -> float:
    """Return the sum of the absolute turns of a path in rad; velocity (n, 3) must not be 0."""
    direction = velocity / np.linalg.norm(velocity, axis=1, keepdims=True)
    cosine = np.einsum("ij,ij->i", direction[1:], direction[:-1])
    sine = np.linalg.norm(np.cross(direction[1:], direction[:-1]), axis=1)
    return float(np.arctan2(sine, cosine).sum())
