"""A straight segment of a path between two poses; translation and rotation start and end together."""

from __future__ import annotations

from math import inf

import msgspec
import numpy as np

from skillc_runtime.motion.paths import segment_sampling as piece
from skillc_runtime.motion.paths.profile import Profile, trapezoidal_profile
from skillc_runtime.motion.paths.smooth import SmoothProfile, smooth_profile, window_for
from skillc_runtime.motion.pose import Array, Pose, log


class MotionLimits(msgspec.Struct, frozen=True):
    """Limits of a planned motion: m/s, m/s^2, rad/s, rad/s^2, m/s^3, rad/s^3.

    In a blend, acceleration and jerk of both segments add up.
    """

    speed: float
    acceleration: float
    turn_speed: float = 0.8
    turn_acceleration: float = 2.0
    jerk: float = inf
    turn_jerk: float = inf

    @property
    def window(self) -> float:
        """The time in s over which motions are averaged so that their jerk stays within limits."""
        return max(window_for(self.acceleration, self.jerk), window_for(self.turn_acceleration, self.turn_jerk))


class Segment(msgspec.Struct, frozen=True):
    """A straight displacement and a rotation about a fixed axis.

    way, turn: the profiles of path length in m and of the rotation angle in rad. axes (2, 6): [direction, 0] of the
    displacement and [0, axis] of the rotation, unit vectors in the parent frame, or zero.
    """

    way: Profile | SmoothProfile
    turn: Profile | SmoothProfile
    axes: Array

    @property
    def duration(self) -> float:
        """The time in s from rest to rest."""
        return max(self.way.duration, self.turn.duration)

    @property
    def rise(self) -> float:
        """The acceleration time in s, the shorter of those of translation and rotation."""
        return min((part.rise for part in (self.way, self.turn) if part.length > 0), default=0.0)

    @property
    def fall(self) -> float:
        """The deceleration time in s, the shorter of those of translation and rotation."""
        return min((part.fall for part in (self.way, self.turn) if part.length > 0), default=0.0)

    @property
    def start_direction(self) -> Array:
        """The unit vector (3,) of the direction at the start, in the parent frame; zero for a rotation only."""
        return self.axes[0, :3]

    @property
    def end_direction(self) -> Array:
        """The unit vector (3,) of the direction at the end, in the parent frame; zero for a rotation only."""
        return self.axes[0, :3]

    def at(self, time: float) -> Array:
        """Return displacement, twist and acceleration (3, 6) `time` s after the start: [linear; angular], m and rad."""
        return piece.sample_segment(self.row, time)

    @property
    def row(self) -> Array:
        """The segment as a row (21,) for `segment_sampling.motion_at`, in m, rad and s."""
        return np.array(
            [*self.way.coefficients, *self.turn.coefficients, *self.axes[1, 3:], 0.0, 0.0, 0.0, *self.axes[0, :3]]
        )

    def transform(self, frame: Pose) -> Segment:
        """Return the same motion in the parent frame of `frame`."""
        return Segment(self.way, self.turn, (self.axes.reshape(4, 3) @ frame.rotation.T).reshape(2, 6))


def segment_between(start: Pose, end: Pose, limits: MotionLimits) -> Segment:
    """Return the straight motion between two poses of one frame; translation and rotation take equally long.

    start, end: the poses.
    """
    direction, length = _unit(end.position - start.position)
    axis, angle = _unit(log(end.rotation @ start.rotation.T))
    way = trapezoidal_profile(length, limits.speed, limits.acceleration)
    turn = trapezoidal_profile(angle, limits.turn_speed, limits.turn_acceleration)
    duration = max(way.duration, turn.duration)
    axes = np.array([[*direction, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, *axis]])
    window = limits.window
    return Segment(
        smooth_profile(way.stretch_to(duration), window), smooth_profile(turn.stretch_to(duration), window), axes
    )


def _unit(vector: Array) -> tuple[Array, float]:
    """Return direction and length of a vector; zeros if it is too short to have a direction."""
    length = float(np.linalg.norm(vector))
    return (vector / length, length) if length > 1e-9 else (np.zeros(3), 0.0)
