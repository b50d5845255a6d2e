"""Checks, before anything moves, whether a motion of the tool stays within the arm's workspace."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise

import numpy as np

from skillc_runtime.control.supervision.safety import Workspace
from skillc_runtime.devices.motion_interface import Infeasible
from skillc_runtime.motion.pose import Array

SAMPLE_S, MAX_SAMPLES = 0.02, 1000
"""Time between samples of a motion, and their greatest number."""

TOLERANCE_M = 1e-4
"""How far a motion may leave the workspace because of rounding."""


def sample_times(duration_s: float) -> Array:
    """Return the times (n,) in s at which a motion is checked, from its start to its end."""
    count = int(np.clip(np.ceil(duration_s / SAMPLE_S), 1, MAX_SAMPLES))
    return np.linspace(0.0, duration_s, count + 1)


def check_motion_inside(workspace: Workspace, points: Iterable[Array]) -> None:
    """Raise Infeasible if a motion of the tool through one or more points (3,), m in base, leaves the workspace.

    A tool that is outside may only come back: it must not go farther away, and be inside at the end.
    """
    places = [(workspace.outside(point), point) for point in points]
    for (before, _), (outside, point) in pairwise(places):
        if outside > before + TOLERANCE_M:
            raise _outside(outside, point)
    if places[-1][0] > TOLERANCE_M:
        raise _outside(*places[-1])


def _outside(distance_m: float, point: Array) -> Infeasible:
    return Infeasible(f"its tool would be {1e3 * distance_m:.0f} mm outside the arm's workspace", point)
