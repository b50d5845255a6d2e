"""One straight piece of motion between two poses, translation and rotation starting and ending together."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np

from skillc_runtime.motion import segment_sampling as piece
from skillc_runtime.motion.pose import Array, Pose, log
from skillc_runtime.motion.profile import Profile, trapezoidal_profile
from skillc_runtime.motion.smooth import SmoothProfile, smooth_profile, window_for


@dataclass(frozen=True, slots=True)
class MotionLimits:
    """How fast a planned motion may be: m/s, m/s^2, rad/s, rad/s^2, m/s^3, rad/s^3; without end unless stated.

    Where motions are blended, acceleration and jerk of both add up.
    """

    speed: float
    acceleration: float
    turn_speed: float = 0.8
    turn_acceleration: float = 2.0
    jerk: float = inf
    turn_jerk: float = inf

    @property
    def window(self) -> float:
        """Seconds over which motions are averaged so that their jerk stays within limits."""
        return max(window_for(self.acceleration, self.jerk), window_for(self.turn_acceleration, self.turn_jerk))


@dataclass(frozen=True, slots=True)
class Segment:
    """A displacement and a turn about a fixed axis.

    axes (2, 6): [direction, 0] of the displacement and [0, axis] of the turn, unit vectors in the parent frame or zero.
    """

    way: Profile | SmoothProfile
    turn: Profile | SmoothProfile
    axes: Array

    @property
    def duration(self) -> float:
        """Seconds from rest to rest."""
        return max(self.way.duration, self.turn.duration)

    @property
    def rise(self) -> float:
        """Seconds in which whatever moves is accelerating."""
        return min((part.rise for part in (self.way, self.turn) if part.length > 0), default=0.0)

    @property
    def fall(self) -> float:
        """Seconds in which whatever moves is decelerating."""
        return min((part.fall for part in (self.way, self.turn) if part.length > 0), default=0.0)

    @property
    def start_direction(self) -> Array:
        """The unit vector (3,) in which it starts; zero for a turn on the spot."""
        return self.axes[0, :3]

    @property
    def end_direction(self) -> Array:
        """The unit vector (3,) in which it ends."""
        return self.axes[0, :3]

    def at(self, time: float) -> Array:
        """Return way, twist and acceleration (3, 6), [linear; angular], `time` s after the start."""
        return piece.sample_segment(self.row, time)

    @property
    def row(self) -> Array:
        """What `piece.motion_at` takes."""
        return np.array(
            [*self.way.coefficients, *self.turn.coefficients, *self.axes[1, 3:], 0.0, 0.0, 0.0, *self.axes[0, :3]]
        )

    def transform(self, frame: Pose) -> Segment:
        """Return the same motion, given in `frame`, in the frame's parent."""
        return Segment(self.way, self.turn, (self.axes.reshape(4, 3) @ frame.rotation.T).reshape(2, 6))


def segment_between(start: Pose, end: Pose, limits: MotionLimits) -> Segment:
    """Return the straight motion between two poses of one frame; the shorter part is slowed down to the longer."""
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
    """Return the direction and the length of a vector; zeros where it is too short to have a direction."""
    length = float(np.linalg.norm(vector))
    return (vector / length, length) if length > 1e-9 else (np.zeros(3), 0.0)
