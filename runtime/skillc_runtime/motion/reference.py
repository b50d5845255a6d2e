"""What a controller is asked to do at one instant, and the seams that say it over time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from skillc_runtime.motion.pose import Array, Pose


@dataclass(frozen=True, slots=True)
class Reference:
    """Where the tool centre point shall be and how it shall move; pose, twist and acceleration in one stated frame.

    twist (6,): [linear m/s, angular rad/s]; acceleration (6,): [m/s^2, rad/s^2]; both along the axes of
    the pose's parent frame.
    """

    pose: Pose
    twist: Array
    acceleration: Array

    def moved(self, frame: Pose) -> Reference:
        """Return the same, given in `frame`, in the frame's parent; `frame` itself rests."""
        R = frame.rotation.T
        turned = [(vector.reshape(2, 3) @ R).ravel() for vector in (self.twist, self.acceleration)]
        return Reference(frame @ self.pose, *turned)


def at_rest(pose: Pose) -> Reference:
    """Return the reference that holds a pose."""
    return Reference(pose, np.zeros(6), np.zeros(6))


@dataclass(frozen=True, slots=True)
class Compliance:
    """How the tool yields and pushes, in the compliance frame C.

    C is the reference tool frame turned by `frame` (3, 3), so it follows the reference. stiffness (6,): N/m, N m/rad;
    wrench (6,): N, N m that the robot exerts on the environment; damping_ratio: 1 is critical. All at the tool centre.
    """

    stiffness: Array
    wrench: Array
    frame: Array
    damping_ratio: float = 1.0


class Trajectory(Protocol):
    """A motion as a pure function of time."""

    @property
    def duration(self) -> float:
        """Seconds from start to rest."""
        ...

    def at(self, time: float) -> Reference:
        """Return the reference `time` seconds after the start; before it the start, after the end the end."""
        ...

    def moved(self, frame: Pose) -> Trajectory:
        """Return the same motion, given in `frame`, in the frame's parent; `frame` itself rests."""
        ...


class Overlay(Protocol):
    """A motion that is added to whatever the tool does, pure in time."""

    def at(self, time: float) -> Array:
        """Return (3, 3): offset m, velocity m/s, acceleration m/s^2, each along the axes the overlay was made for."""
        ...
