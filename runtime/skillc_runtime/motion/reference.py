"""What a controller is asked to do at one instant, and the seams that say it over time."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from skillc_runtime.motion.arrays import Matrix, Vector
from skillc_runtime.motion.pose import Array, Pose

POSITION, ROTATION, TWIST, ACCELERATION = slice(0, 1), slice(1, 4), slice(4, 6), slice(6, 8)
"""Rows of `Reference.rows`."""


@dataclass(frozen=True, slots=True)
class Reference:
    """Where the tool centre point shall be and how it shall move; pose, twist and acceleration in one stated frame.

    rows (8, 3): all of it, one argument for compiled functions. Both motions are along the axes of the pose's parent
    frame.
    """

    rows: Matrix

    @staticmethod
    def of(pose: Pose, twist: Array, acceleration: Array) -> Reference:
        """Return the reference of a pose, a twist (6,) and an acceleration (6,)."""
        rows = np.empty((8, 3))
        rows[POSITION], rows[ROTATION] = pose.position, pose.rotation
        rows[TWIST], rows[ACCELERATION] = twist.reshape(2, 3), acceleration.reshape(2, 3)
        return Reference(rows)

    @property
    def pose(self) -> Pose:
        """Where the tool shall be."""
        return Pose(self.rows[0], self.rows[ROTATION])

    @property
    def twist(self) -> Array:
        """Its velocity (6,): [linear m/s, angular rad/s]."""
        return self.rows[TWIST].ravel()

    @property
    def acceleration(self) -> Array:
        """Its acceleration (6,): [linear m/s^2, angular rad/s^2]."""
        return self.rows[ACCELERATION].ravel()

    def transform(self, frame: Pose) -> Reference:
        """Return the same, given in `frame`, in the frame's parent; `frame` itself rests."""
        rows = self.rows @ frame.rotation.T
        rows[POSITION] += frame.position
        rows[ROTATION] = frame.rotation @ self.rows[ROTATION]
        return Reference(rows)


def resting_reference(pose: Pose) -> Reference:
    """Return the reference that holds a pose."""
    return Reference.of(pose, np.zeros(6), np.zeros(6))


UNLIMITED_SPEED: Array = np.full(3, np.inf)
UNLIMITED_SPEED.flags.writeable = False


@dataclass(frozen=True, slots=True)
class Compliance:
    """How the tool yields and pushes, in the compliance frame C.

    C is the reference tool frame turned by `frame` (3, 3), so it follows the reference. stiffness (6,): N/m, N m/rad;
    wrench (6,): N, N m that the robot exerts on the environment; damping_ratio: 1 is critical. All at the tool centre.
    fastest (3,): m/s along C's axes; its sign says which way the tool yields no faster, infinite lets it go.
    """

    stiffness: Vector
    wrench: Vector
    frame: Matrix
    damping_ratio: float = 1.0
    fastest: Vector = field(default_factory=lambda: UNLIMITED_SPEED)


class Trajectory(Protocol):
    """A motion as a pure function of time."""

    @property
    def duration(self) -> float:
        """Seconds from start to rest."""
        ...

    def at(self, time: float) -> Reference:
        """Return the reference `time` seconds after the start; before it the start, after the end the end."""
        ...

    def transform(self, frame: Pose) -> Trajectory:
        """Return the same motion, given in `frame`, in the frame's parent; `frame` itself rests."""
        ...


class Overlay(Protocol):
    """A motion that is added to whatever the tool does, pure in time."""

    def at(self, time: float) -> Array:
        """Return (3, 3): offset m, velocity m/s, acceleration m/s^2, each along the axes the overlay was made for."""
        ...
