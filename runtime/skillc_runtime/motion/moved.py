"""The same motion seen from another frame."""

from __future__ import annotations

from dataclasses import dataclass

from skillc_runtime.motion.pose import Pose
from skillc_runtime.motion.reference import Reference, Trajectory


@dataclass(frozen=True, slots=True)
class Moved:
    """A trajectory whose frame lies at `frame` in the frame it is wanted in."""

    trajectory: Trajectory
    frame: Pose

    @property
    def duration(self) -> float:
        """Seconds from start to rest."""
        return self.trajectory.duration

    def at(self, time: float) -> Reference:
        """Return the reference."""
        return moved(self.trajectory.at(time), self.frame)


def moved(reference: Reference, frame: Pose) -> Reference:
    """Return a reference, given in `frame`, in the frame's parent; `frame` itself rests."""
    R = frame.rotation.T
    return Reference(
        frame @ reference.pose,
        (reference.twist.reshape(2, 3) @ R).ravel(),
        (reference.acceleration.reshape(2, 3) @ R).ravel(),
    )
