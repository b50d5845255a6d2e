"""Straight lines in joint space: all joints start and stop together, and none exceeds its limits."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.profile import Profile, trapezoidal_profile


@dataclass(frozen=True, slots=True)
class JointReference:
    """The reference of the joints at one instant: q, dq, ddq (nv,) in rad, rad/s, rad/s^2."""

    q: Array
    dq: Array
    ddq: Array


class JointTrajectory(Protocol):
    """A motion of the joints from rest to rest, as a pure function of time."""

    @property
    def start(self) -> Array:
        """The joint positions (nv,) in rad at the start."""
        ...

    @property
    def end(self) -> Array:
        """The joint positions (nv,) in rad at the end."""
        ...

    @property
    def duration(self) -> float:
        """The time in s from rest to rest."""
        ...

    def at(self, time: float) -> JointReference:
        """Return the reference `time` s after the start.

        It rests at the start before that, and at the end afterwards.
        """
        ...


@dataclass(frozen=True, slots=True)
class JointMotion:
    """A motion from `start` by `change`, both joint positions (nv,) in rad; the profile goes from 0 to 1."""

    start: Array
    change: Array
    profile: Profile

    @property
    def end(self) -> Array:
        """The joint positions (nv,) in rad at the end."""
        return self.start + self.change

    @property
    def duration(self) -> float:
        """The time in s from rest to rest."""
        return self.profile.duration

    def at(self, time: float) -> JointReference:
        """Return the reference `time` s after the start."""
        way, dq, ddq = np.multiply.outer(self.profile.at(time), self.change)
        return JointReference(self.start + way, dq, ddq)


def joint_motion(start: Array, goal: Array, speed: Array, acceleration: Array) -> JointMotion:
    """Return the fastest synchronised motion between joint positions (nv,) in rad.

    speed, acceleration (nv,): limits > 0 in rad/s and rad/s^2.
    """
    change = goal - start
    if np.abs(change).max() < 1e-9:
        return JointMotion(start.copy(), change, Profile(0.0, 0.0, 1.0, 1.0))
    distance = np.maximum(np.abs(change), 1e-12)
    profile = trapezoidal_profile(1.0, float((speed / distance).min()), float((acceleration / distance).min()))
    return JointMotion(start.copy(), change, profile)
