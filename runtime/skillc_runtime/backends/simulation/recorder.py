"""The recording of a run: the true values of every simulation step, in arrays that grow by doubling."""

from __future__ import annotations

import numpy as np

from skillc_runtime.devices.ground_truth import Recording
from skillc_runtime.motion.pose import Array
from skillc_runtime.motion.reference import Reference

MEASURED = 12
"""time; normal force; face position 3, quaternion 4, velocity 3."""

COLUMNS = 25
"""Those, then position 3 and velocity 3 of the reference, and the same of the path: the reference without overlays; the
normal force on a surface."""


class Recorder:
    """Records one row per step for one tool, and the reference, which is smooth, at a lower rate."""

    def __init__(self, truth: Array, expected_steps: int = 1 << 16) -> None:
        """`truth` (11,) is the view of the tool's sensors: force, position 3, quaternion 4, velocity 3."""
        self._truth = truth
        self._rows = np.empty((expected_steps, MEASURED))
        self._count = 0
        self._references: list[tuple[float, Array]] = []
        self._made = Recording(np.empty((0, COLUMNS)))

    def sample(self, time: float) -> None:
        """Record the row of one step that began at `time` s."""
        if self._count == len(self._rows):
            self._rows = np.concatenate([self._rows, np.empty_like(self._rows)])
        row = self._rows[self._count]
        row[0], row[1:] = time, self._truth
        self._count += 1

    def sample_reference(self, time: float, reference: Reference, path: Reference, on_surface_n: float) -> None:
        """Record reference and path in the world at `time` s, and the force on a surface in N."""
        asked = (reference.pose.position, reference.twist[:3], path.pose.position, path.twist[:3], (on_surface_n,))
        self._references.append((time, np.concatenate(asked)))

    def mean_force_n(self, since: float) -> float:
        """Return the mean normal force in N of the steps from `since` in s on, 0 if there is none."""
        rows = self._rows[: self._count]
        first = int(np.searchsorted(rows[:, 0], since))
        return float(rows[first:, 1].mean()) if first < len(rows) else 0.0

    def recording(self) -> Recording:
        """Return a read-only copy of the recording; references are interpolated between samples.

        It is made once for all who ask between two steps.
        """
        if len(self._made.rows) == self._count:
            return self._made
        rows = np.empty((self._count, COLUMNS))
        rows[:, :MEASURED] = self._rows[: self._count]
        if self._references:
            times = np.array([time for time, _ in self._references])
            asked = np.array([values for _, values in self._references])
            for column, values in enumerate(asked.T, start=MEASURED):
                rows[:, column] = np.interp(rows[:, 0], times, values)
        rows.flags.writeable = False
        self._made = Recording(rows)
        return self._made
