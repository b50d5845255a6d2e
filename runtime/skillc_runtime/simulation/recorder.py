"""The recording of a run: what really happened at every simulation step, in arrays that grow by doubling."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.reference import Reference

MEASURED = 12
"""time; normal force; face position 3, quaternion 4, velocity 3."""

COLUMNS = 25
"""Those, then position 3 and velocity 3 of the reference, and the same of the path: the reference without overlays; the
normal force on a surface."""


@dataclass(frozen=True, slots=True)
class Recording:
    """A stretch of a run, one row a step, read-only. Truth from the simulator, in the world, SI units.

    force (n,): N, normal force of all contacts of the tool's working face. position (n, 3), quaternion (n, 4),
    velocity (n, 3): of the middle of that face, z out of the tool. reference, reference_velocity (n, 3): what the
    arm's controller was asked for; path, path_velocity (n, 3): the same without overlays. on_surface (n,): N, of the
    force on the face that part which presses on a surface, and not on what lies on it.
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


class Recorder:
    """Takes one row a step for one tool, and the reference, which is smooth, every so often."""

    def __init__(self, truth: Array, expected_steps: int = 1 << 16) -> None:
        """`truth` (11,) is the view of the tool's sensors: force, position 3, quaternion 4, velocity 3."""
        self._truth = truth
        self._rows = np.empty((expected_steps, MEASURED))
        self._count = 0
        self._references: list[tuple[float, Array]] = []

    def sample(self, time: float) -> None:
        """Take the row of one step that began at `time` s."""
        if self._count == len(self._rows):
            self._rows = np.concatenate([self._rows, np.empty_like(self._rows)])
        row = self._rows[self._count]
        row[0], row[1:] = time, self._truth
        self._count += 1

    def sample_reference(self, time: float, reference: Reference, path: Reference, on_surface_n: float) -> None:
        """Take what the arm is asked for at `time` s, and the same without overlays, in the world; the force there."""
        asked = (reference.pose.position, reference.twist[:3], path.pose.position, path.twist[:3], (on_surface_n,))
        self._references.append((time, np.concatenate(asked)))

    def recording(self) -> Recording:
        """Return what was taken so far, as a read-only copy; between two samples those are interpolated."""
        rows = np.empty((self._count, COLUMNS))
        rows[:, :MEASURED] = self._rows[: self._count]
        if self._references:
            times = np.array([time for time, _ in self._references])
            asked = np.array([values for _, values in self._references])
            for column, values in enumerate(asked.T, start=MEASURED):
                rows[:, column] = np.interp(rows[:, 0], times, values)
        rows.flags.writeable = False
        return Recording(rows)
