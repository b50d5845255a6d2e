"""References and compliance that a controller receives, and the protocols of motions over time."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import msgspec
import numpy as np

from skillc_runtime.motion.arrays import Matrix, Vector
from skillc_runtime.motion.pose import Array, Pose

POSITION, ROTATION, TWIST, ACCELERATION = slice(0, 1), slice(1, 4), slice(4, 6), slice(6, 8)
"""Rows of `Reference.rows`."""


class Reference(msgspec.Struct, frozen=True):
    """The desired pose, twist and acceleration of the tool centre point, all in the parent frame of the pose.

    rows (8, 3): position in m, rotation, twist in m/s and rad/s, acceleration in m/s^2 and rad/s^2; one array, since
    each argument of a compiled function costs time.
    """

    rows: Matrix

    @staticmethod
    def of(pose: Pose, twist: Array, acceleration: Array) -> Reference:
        """Return the reference of a pose, a twist and an acceleration.

        pose: of the tool centre point, in its parent frame.
        twist: (6,) in m/s and rad/s, [linear; angular] in the same frame.
        acceleration: (6,) in m/s^2 and rad/s^2, [linear; angular] in the same frame.
        """
        rows = np.empty((8, 3))
        rows[POSITION], rows[ROTATION] = pose.position, pose.rotation
        rows[TWIST], rows[ACCELERATION] = twist.reshape(2, 3), acceleration.reshape(2, 3)
        return Reference(rows)

    @property
    def pose(self) -> Pose:
        """The desired pose."""
        return Pose(self.rows[0], self.rows[ROTATION])

    @property
    def twist(self) -> Array:
        """The desired twist (6,): [linear m/s; angular rad/s]."""
        return self.rows[TWIST].ravel()

    @property
    def acceleration(self) -> Array:
        """The desired acceleration (6,): [linear m/s^2; angular rad/s^2]."""
        return self.rows[ACCELERATION].ravel()

    def transform(self, frame: Pose) -> Reference:
        """Return the reference in the parent frame of `frame`, which does not move."""
        rows = self.rows @ frame.rotation.T
        rows[POSITION] += frame.position
        rows[ROTATION] = frame.rotation @ self.rows[ROTATION]
        return Reference(rows)


def resting_reference(pose: Pose) -> Reference:
    """Return the reference that holds a pose, in the same frame."""
    return Reference.of(pose, np.zeros(6), np.zeros(6))


class SampledReference(Protocol):
    """A reference as a control law reads it."""

    @property
    def rows(self) -> Matrix:
        """The rows (8, 3), as in `Reference`: m, rad and s, in its frame."""
        ...


UNLIMITED_SPEED: Array = np.full(3, np.inf)
UNLIMITED_SPEED.flags.writeable = False


@dataclass(frozen=True, slots=True)
class Compliance:
    """Stiffness and exerted wrench of the tool, in the compliance frame C at the tool centre point.

    C is the reference tool frame rotated by `frame` (3, 3), so it follows the reference. stiffness (6,): N/m, N m/rad;
    wrench (6,): N, N m that the robot exerts on the environment; damping_ratio: 1 is critical. fastest (3,): m/s along
    the axes of C, the greatest speed in the direction of its sign; infinite for no limit.
    """

    stiffness: Vector
    wrench: Vector
    frame: Matrix
    damping_ratio: float = 1.0
    fastest: Vector = field(default_factory=lambda: UNLIMITED_SPEED)


class AppliedCompliance(Protocol):
    """A compliance as a control law reads it, as in `Compliance`."""

    @property
    def stiffness(self) -> Vector:
        """The stiffness (6,), N/m and N m/rad, along the axes of C."""
        ...

    @property
    def wrench(self) -> Vector:
        """The exerted wrench (6,), N and N m, along the axes of C."""
        ...

    @property
    def frame(self) -> Matrix:
        """The axes (3, 3) of C in the reference tool frame."""
        ...

    @property
    def damping_ratio(self) -> float:
        """The damping ratio."""
        ...

    @property
    def fastest(self) -> Vector:
        """The greatest speed (3,) along the axes of C, m/s."""
        ...


class Trajectory(Protocol):
    """A motion of the tool as a pure function of time."""

    @property
    def duration(self) -> float:
        """The time in s from start to rest."""
        ...

    def at(self, time: float) -> Reference:
        """Return the reference `time` s after the start.

        It rests at the start before that, and at the end afterwards.
        """
        ...

    def transform(self, frame: Pose) -> Trajectory:
        """Return the same motion in the parent frame of `frame`, which does not move."""
        ...


class Overlay(Protocol):
    """A motion that is added to the motion of the tool, as a pure function of time."""

    def at(self, time: float) -> Array:
        """Return offset, velocity and acceleration (3, 3) at `time` s: m, m/s, m/s^2, in the overlay's frame."""
        ...
