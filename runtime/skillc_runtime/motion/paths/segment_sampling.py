"""A segment of a path, line or arc with a rotation about a fixed axis, as a row of numbers, and the motion along it."""

from __future__ import annotations

from math import cos, sin, sqrt

import numpy as np

from skillc_runtime.motion.arrays import OutMatrix, Vector
from skillc_runtime.motion.numerics.compiled import compiled, inlined
from skillc_runtime.motion.paths.smooth import smooth_at
from skillc_runtime.motion.pose import Array

WAY, TURN = 0, 6
"""Columns of the two profiles: length, peak, acceleration, deceleration, rate, window each."""

AXIS, SPOKE, ACROSS = 12, 15, 18
"""Columns of vectors (3,) in the frame of the path: unit axis of the rotation; from the centre of an arc to its start,
zero for a line; direction at the start.

The last is a unit vector for a line and as long as the radius for an arc.
"""

COLUMNS = 21


@inlined
def _profile_at(row: Array, first: int, time: float) -> tuple[float, float, float]:
    return smooth_at(row[first], row[first + 1], row[first + 2], row[first + 3], row[first + 4], row[first + 5], time)


@inlined
def _arc_at(motion: Array, way: tuple[float, float, float], spoke: Array, across: Array, radius: float) -> None:
    """Compute the linear part of the motion: phi = s / r, along = across cos phi - spoke sin phi, and so on."""
    angle, rate, change = way[0] / radius, way[1] / radius, way[2] / radius
    c, s = cos(angle), sin(angle)
    for i in range(3):
        along, inward = c * across[i] - s * spoke[i], c * spoke[i] + s * across[i]
        motion[0, i] = s * across[i] + (c - 1) * spoke[i]
        motion[1, i] = rate * along
        motion[2, i] = change * along - rate * rate * inward


@compiled
def motion_at(motion: OutMatrix, row: Vector, time: float) -> None:
    """Compute displacement, twist and acceleration of a segment, in the frame of the path.

    motion: (3, 6), [linear; angular] in m, m/s, m/s^2 and rad; it is written.
    row: (21,) in m, rad and s, a segment.
    time: s, after its start.
    """
    way, turn = _profile_at(row, WAY, time), _profile_at(row, TURN, time)
    spoke, across = row[SPOKE : SPOKE + 3], row[ACROSS : ACROSS + 3]
    radius = sqrt(spoke[0] * spoke[0] + spoke[1] * spoke[1] + spoke[2] * spoke[2])
    for i in range(3):
        for j in range(3):
            motion[i, j] = way[i] * across[j]
            motion[i, 3 + j] = turn[i] * row[AXIS + j]
    if radius > 0.0:
        _arc_at(motion, way, spoke, across, radius)


def sample_segment(row: Array, time: float) -> Array:
    """Return what `motion_at` computes, (3, 6), for the `row` (21,) of a segment, in m, rad, s and the path's frame.

    time: s, after its start.
    """
    motion = np.empty((3, 6))
    motion_at(motion, row, time)
    return motion
