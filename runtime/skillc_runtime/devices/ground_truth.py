"""What really happens in a cell, which only a simulation knows: for reports and trials, never for skills."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from skillc_runtime.motion.pose import Array, Pose


@dataclass(frozen=True, slots=True)
class Recording:
    """A stretch of a run, one row a step, read-only. Truth from the simulator, in the world, SI units.

    force (n,): N, normal force of all contacts of the tool's working face. position (n, 3), quaternion (n, 4),
    velocity (n, 3): of the middle of that face, z out of the tool. reference, reference_velocity (n, 3): what the
    arm's controller was asked for; path, path_velocity (n, 3): the same without overlays. on_surface (n,): N, of the
    force on the face that part which presses on a surface, and not on what lies on it. rows (n, 25): all of it.
    """

    rows: Array

    @property
    def time(self) -> Array:
        """Seconds since the cell started (n,)."""
        return self.rows[:, 0]

    @property
    def force(self) -> Array:
        """Normal force (n,) in N."""
        return self.rows[:, 1]

    @property
    def position(self) -> Array:
        """Position of the working face (n, 3) in m."""
        return self.rows[:, 2:5]

    @property
    def quaternion(self) -> Array:
        """Orientation of the working face (n, 4), w first."""
        return self.rows[:, 5:9]

    @property
    def velocity(self) -> Array:
        """Velocity of the working face (n, 3) in m/s."""
        return self.rows[:, 9:12]

    @property
    def reference(self) -> Array:
        """Position the controller was asked for (n, 3) in m."""
        return self.rows[:, 12:15]

    @property
    def reference_velocity(self) -> Array:
        """Velocity the controller was asked for (n, 3) in m/s."""
        return self.rows[:, 15:18]

    @property
    def path(self) -> Array:
        """Position the controller was asked for, overlays aside (n, 3) in m."""
        return self.rows[:, 18:21]

    @property
    def path_velocity(self) -> Array:
        """Velocity the controller was asked for, overlays aside (n, 3) in m/s."""
        return self.rows[:, 21:24]

    @property
    def on_surface(self) -> Array:
        """Normal force on a surface itself (n,) in N."""
        return self.rows[:, 24]

    def between(self, start: float, end: float) -> Recording:
        """Return the rows with start <= time < end."""
        first, last = np.searchsorted(self.time, (start, end))
        return Recording(self.rows[first:last])

    def without(self, stretches: Sequence[tuple[float, float]]) -> Recording:
        """Return the rows before the last of some stretches, s, that are in none of them."""
        wanted = self.time < max(end for _, end in stretches)
        for start, end in stretches:
            wanted &= (self.time < start) | (self.time >= end)
        return Recording(self.rows[wanted])


def join_recordings(stretches: Sequence[Recording]) -> Recording:
    """Return the rows of several stretches one after the other."""
    return stretches[0] if len(stretches) == 1 else Recording(np.concatenate([each.rows for each in stretches]))


class GroundTruth(Protocol):
    """The truth about a cell; things are named by their IRIs. `Cell` does not offer it, so no primitive sees it."""

    def recording(self, tool: str) -> Recording:
        """Return what was recorded of a tool while it was held; KeyError where the cell has no such tool."""
        ...

    def peak_force_n(self, tool: str) -> float:
        """Return the greatest force on a tool while it was held; KeyError where the cell has no such tool."""
        ...

    def surface_pose(self, surface: str) -> Pose:
        """Return where a surface really is, in the world; KeyError where the cell has no such surface."""
        ...
