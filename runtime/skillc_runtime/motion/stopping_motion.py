"""Coming to rest: what is left of an earlier motion, added to the motion that follows, so that nothing jumps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from skillc_runtime.motion.pose import Array


@dataclass(frozen=True, slots=True)
class StoppingMotion:
    """A velocity (n,) in m/s or rad/s that falls evenly to nothing within `duration` s.

    Places, m or rad, count from where it comes to rest.
    """

    velocity: Array
    duration: float

    @property
    def way(self) -> Array:
        """How far (n,) it goes until it rests, m or rad."""
        return self.velocity * (self.duration / 2)

    def at(self, time: float) -> tuple[Array, Array, Array]:
        """Return place, velocity and acceleration (n,) `time` s after the start; nothing after the end."""
        left = 1 - time / self.duration if time < self.duration else 0.0
        if left <= 0:
            nothing = np.zeros_like(self.velocity)
            return nothing, nothing, nothing
        return -self.way * (left * left), self.velocity * left, self.velocity * (-1 / self.duration)


def stopping_motion(velocity: Array, deceleration: float) -> StoppingMotion:
    """Return the stop from a velocity (n,) whose length, or greatest joint speed, falls by `deceleration` per s.

    velocity (n,): m/s or rad/s.
    """
    speed = float(np.abs(velocity).max()) if velocity.size else 0.0
    return StoppingMotion(velocity.copy(), speed / deceleration)
