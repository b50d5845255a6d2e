"""A straight line in joint space: all joints start and stop together, none exceeds its limits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.profile import Profile, trapezoidal_profile


@dataclass(frozen=True, slots=True)
class JointReference:
    """Where the joints shall be: q, dq, ddq (nv,) in rad, rad/s, rad/s^2."""

    q: Array
    dq: Array
    ddq: Array


class JointTrajectory(Protocol):
    """A motion of the joints, from rest to rest, as a pure function of time."""

    @property
    def start(self) -> Array:
        """Where it begins, (nv,) in rad."""
        ...

    @property
    def end(self) -> Array:
        """Where it ends, (nv,) in rad."""
        ...

    @property
    def duration(self) -> float:
        """Seconds from rest to rest."""
        ...

    def at(self, time: float) -> JointReference:
        """Return the reference `time` s after the start; before it the start, after the end the end."""
        ...


@dataclass(frozen=True, slots=True)
class JointMotion:
    """A motion from `start` by `change`, both (nv,) in rad; the profile runs from 0 to 1."""

    start: Array
    change: Array
    profile: Profile

    @property
    def end(self) -> Array:
        """Where it ends, (nv,) in rad."""
        return self.start + self.change

    @property
    def duration(self) -> float:
        """Seconds from rest to rest."""
        return self.profile.duration

    def at(self, time: float) -> JointReference:
        """Return the reference `time` s after the start."""
        way, dq, ddq = np.multiply.outer(self.profile.at(time), self.change)
        return JointReference(self.start + way, dq, ddq)


def joint_motion(start: Array, goal: Array, speed: Array, acceleration: Array) -> JointMotion:
    """Return the fastest synchronised motion within joint speeds and accelerations (nv,) > 0, in rad/s and rad/s^2."""
    change = goal - start
    if np.abs(change).max() < 1e-9:
        return JointMotion(start.copy(), change, Profile(0.0, 0.0, 1.0, 1.0))
    way = np.maximum(np.abs(change), 1e-12)
    return JointMotion(
        start.copy(), change, trapezoidal_profile(1.0, float((speed / way).min()), float((acceleration / way).min()))
    )
