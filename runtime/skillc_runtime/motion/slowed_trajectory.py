"""The same motion, more slowly."""

from __future__ import annotations

from dataclasses import dataclass

from skillc_runtime.motion.pose import Pose
from skillc_runtime.motion.reference import Reference, Trajectory


@dataclass(frozen=True, slots=True)
class SlowedTrajectory:
    """A trajectory that takes `factor` >= 1 times as long, along the same way."""

    trajectory: Trajectory
    factor: float

    @property
    def duration(self) -> float:
        """Seconds from start to rest."""
        return self.trajectory.duration * self.factor

    def at(self, time: float) -> Reference:
        """Return the reference `time` s after the start."""
        fast = self.trajectory.at(time / self.factor)
        return Reference.of(fast.pose, fast.twist / self.factor, fast.acceleration / self.factor**2)

    def transform(self, frame: Pose) -> SlowedTrajectory:
        """Return the same motion, given in `frame`, in the frame's parent."""
        return SlowedTrajectory(self.trajectory.transform(frame), self.factor)


def slow_down(trajectory: Trajectory, factor: float) -> Trajectory:
    """Return a trajectory that is slower by a factor; unchanged for one of 1 or less."""
    return SlowedTrajectory(trajectory, factor) if factor > 1 else trajectory
