"""Coming to rest: the rest of an earlier motion, added to the next motion so that the reference does not jump."""

from __future__ import annotations

import msgspec
import numpy as np

from skillc_runtime.motion.arrays import OutMatrix, Vector
from skillc_runtime.motion.numerics.compiled import compiled
from skillc_runtime.motion.pose import Array


class StoppingMotion(msgspec.Struct, frozen=True):
    """A velocity (n,) in m/s or rad/s that decreases linearly to zero within `duration` s.

    Displacements in m or rad are relative to where it comes to rest.
    """

    velocity: Array
    duration: float

    @property
    def displacement(self) -> Array:
        """The displacement (n,) until it rests, m or rad."""
        return self.velocity * (self.duration / 2)

    def at(self, time: float) -> tuple[Array, Array, Array]:
        """Return displacement, velocity and acceleration (n,) `time` s after the start; zeros after the end."""
        displacement, velocity, acceleration = motion = np.empty((3, self.velocity.size))
        stop_at(motion, self.velocity, self.duration, time)
        return displacement, velocity, acceleration


@compiled
def stop_at(motion: OutMatrix, velocity: Vector, duration: float, time: float) -> None:
    """Compute displacement, velocity and acceleration of a `StoppingMotion`, in its units and frame.

    motion: (3, n) in m or rad, and s; it is written.
    velocity: (n,) in m/s or rad/s, at the start.
    duration: s, of the stop.
    time: s, since the start.
    """
    left = 1 - time / duration if time < duration else 0.0
    for i in range(velocity.size):
        motion[0, i] = -(velocity[i] * (duration / 2)) * (left * left)
        motion[1, i] = velocity[i] * left
        motion[2, i] = velocity[i] * (-1 / duration) if left > 0.0 else 0.0


def stopping_motion(velocity: Array, deceleration: float) -> StoppingMotion:
    """Return the stop from a velocity (n,) whose greatest component decreases by `deceleration` per s.

    velocity (n,): m/s or rad/s; deceleration: m/s^2 or rad/s^2.
    """
    speed = float(np.abs(velocity).max()) if velocity.size else 0.0
    return StoppingMotion(velocity.copy(), speed / deceleration)
