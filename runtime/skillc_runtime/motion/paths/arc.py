"""A circular segment of a path between two poses; translation and rotation start and end together."""

from __future__ import annotations

from math import atan2, cos, pi, sin, sqrt

import msgspec
import numpy as np

from skillc_runtime.motion.paths import segment_sampling as piece
from skillc_runtime.motion.paths.profile import Profile, trapezoidal_profile
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.paths.smooth import SmoothProfile, smooth_profile
from skillc_runtime.motion.pose import Array, Pose, log

STRAIGHT = 1e-6
"""Sine of the angle between two chords below which three points count as collinear."""


class Arc(msgspec.Struct, frozen=True):
    """A motion along a circle and a rotation about a fixed axis; all vectors in the parent frame.

    way, turn: the profiles of path length in m and of the rotation angle in rad. spoke (3,) m: from the centre to the
    start. across (3,) m: the spoke rotated by 90 deg towards the end. axis (3,): unit vector of the rotation, or zero.
    """

    way: Profile | SmoothProfile
    turn: Profile | SmoothProfile
    spoke: Array
    across: Array
    axis: Array

    @property
    def radius(self) -> float:
        """The radius of the circle in m."""
        return float(np.linalg.norm(self.spoke))

    @property
    def duration(self) -> float:
        """The time in s from rest to rest."""
        return max(self.way.duration, self.turn.duration)

    @property
    def rise(self) -> float:
        """The acceleration time in s, the shorter of those of translation and rotation."""
        return min(part.rise for part in (self.way, self.turn) if part.length > 0)

    @property
    def fall(self) -> float:
        """The deceleration time in s, the shorter of those of translation and rotation."""
        return min(part.fall for part in (self.way, self.turn) if part.length > 0)

    @property
    def start_direction(self) -> Array:
        """The unit vector (3,) of the direction at the start, in the parent frame."""
        return self.across / self.radius

    @property
    def end_direction(self) -> Array:
        """The unit vector (3,) of the direction at the end, in the parent frame."""
        angle = self.way.length / self.radius
        return (cos(angle) * self.across - sin(angle) * self.spoke) / self.radius

    def at(self, time: float) -> Array:
        """Return displacement, twist and acceleration (3, 6) `time` s after the start: [linear; angular], m and rad."""
        return piece.sample_segment(self.row, time)

    @property
    def row(self) -> Array:
        """The segment as a row (21,) for `segment_sampling.motion_at`, in m, rad and s."""
        return np.array([*self.way.coefficients, *self.turn.coefficients, *self.axis, *self.spoke, *self.across])

    def transform(self, frame: Pose) -> Arc:
        """Return the same motion in the parent frame of `frame`."""
        R = frame.rotation
        return Arc(self.way, self.turn, R @ self.spoke, R @ self.across, R @ self.axis)


def arc_through(start: Pose, via: Array, end: Pose, limits: MotionLimits) -> Arc:
    """Return the motion between two poses along the circle through a point, all in the same frame.

    Raises ValueError if the three points are collinear or coincide.
    start: pose in any frame.
    via: (3,) in m, in the same frame.
    end: pose in the same frame.
    """
    one, other = via - start.position, end.position - start.position
    normal = np.cross(one, other)
    size = float(np.linalg.norm(normal))
    if size <= STRAIGHT * float(np.linalg.norm(one)) * float(np.linalg.norm(other)) or size == 0:
        raise ValueError("three points on a line make no circle")
    to_centre = np.cross(one @ one * other - other @ other * one, normal) / (2 * size**2)
    return arc_around(
        start, start.position + to_centre, normal / size, _angle(-to_centre, other, normal / size), end, limits
    )


def arc_around(start: Pose, centre: Array, normal: Array, angle: float, end: Pose, limits: MotionLimits) -> Arc:
    """Return the motion around a centre by an angle about a normal, all in the same frame.

    Only the rotation of `end` is used. The speed is lowered where the centripetal acceleration would exceed the limit.
    Raises ValueError if the start is at the centre.
    start: pose in any frame.
    centre: (3,) in m, in the same frame.
    normal: (3,), a unit vector in the same frame.
    angle: rad, above 0.
    end: pose in the same frame.
    """
    spoke = start.position - centre
    spoke = spoke - (spoke @ normal) * normal
    radius = float(np.linalg.norm(spoke))
    if radius < 1e-9 or angle <= 0:
        raise ValueError(f"an arc needs a radius and an angle above 0: {radius:g} m, {angle:g} rad")
    rotation = log(end.rotation @ start.rotation.T)
    turned = float(np.linalg.norm(rotation))
    acceleration = limits.acceleration / sqrt(2)
    way = trapezoidal_profile(radius * angle, min(limits.speed, sqrt(acceleration * radius)), acceleration)
    turn = trapezoidal_profile(turned, limits.turn_speed, limits.turn_acceleration)
    duration, window = max(way.duration, turn.duration), limits.window
    axis = rotation / turned if turned > 1e-9 else np.zeros(3)
    moving, turning = (
        smooth_profile(way.stretch_to(duration), window),
        smooth_profile(turn.stretch_to(duration), window),
    )
    return Arc(moving, turning, spoke, np.cross(normal, spoke), axis)


def _angle(spoke: Array, chord: Array, normal: Array) -> float:
    """Return the angle in rad, 0 to 2 pi, about the normal between a spoke and the spoke at the end of a chord."""
    end = spoke + chord
    return atan2(float(np.cross(spoke, end) @ normal), float(spoke @ end)) % (2 * pi)
