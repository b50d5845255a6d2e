"""The recording of a run: the true values of every simulation step, in arrays that grow by doubling."""

from __future__ import annotations

import msgspec
import numpy as np

from skillc_runtime.devices.ground_truth import Recording
from skillc_runtime.motion.arrays import Matrix, OutMatrix, OutVector, Vector
from skillc_runtime.motion.numerics.compiled import inlined
from skillc_runtime.motion.numerics.linear import copy_vector, times
from skillc_runtime.motion.pose import Array, Pose

MEASURED = 12
"""time; normal force; face position 3, quaternion 4, velocity 3."""

COLUMNS = 25
"""Those, then position 3 and velocity 3 of the reference, and the same of the path: the reference without overlays; the
normal force on a surface."""


class RecordedSteps(msgspec.Struct, frozen=True):
    """rows (n, 12), of which `count` (1,) are filled; truth (11,): what is recorded, as of the last step."""

    rows: OutMatrix
    count: OutVector
    truth: Vector


@inlined
def record(steps: RecordedSteps, time: float) -> bool:
    """Record the row of one step that began at `time` s; return False, and do nothing, if there is no room."""
    number = int(steps.count[0])
    if number == steps.rows.shape[0]:
        return False
    steps.rows[number, 0] = time
    copy_vector(steps.truth, steps.rows[number, 1:])
    steps.count[0] += 1.0
    return True


class SampledReference(msgspec.Struct, frozen=True):
    """A reference and where it is sampled.

    rows, path (8, 3): of the tool, in base, with and without overlays; base: in the world; greatest (1,): the force on
    a surface so far, N; steps (1,): that were observed. asked (n, 14), of which `count` (1,) rows are filled: time,
    position and velocity of both, force.
    """

    rows: Matrix
    path: Matrix
    base: Pose
    greatest: OutVector
    steps: Vector
    asked: OutMatrix
    count: OutVector


@inlined
def put_reference(sampled: SampledReference, time: float) -> None:
    """Sample reference and path in the world at `time` s, and the greatest force since the sample before."""
    asked, base = sampled.asked[int(sampled.count[0])], sampled.base
    asked[0], asked[13] = time, sampled.greatest[0]
    times(base.rotation, sampled.rows[0], asked[1:4])
    times(base.rotation, sampled.rows[4], asked[4:7])
    times(base.rotation, sampled.path[0], asked[7:10])
    times(base.rotation, sampled.path[4], asked[10:13])
    for i in range(3):
        asked[1 + i] += base.position[i]
        asked[7 + i] += base.position[i]
    sampled.count[0] += 1.0
    sampled.greatest[0] = 0.0


class ToolRecorder:
    """Records one row per step for one tool, and the reference, which is smooth, at a lower rate."""

    def __init__(self, truth: Array, expected_steps: int = 1 << 16) -> None:
        """`truth` (11,) is the view of the tool's sensors: force, position 3, quaternion 4, velocity 3."""
        self._truth = truth
        self._rows = np.empty((expected_steps, MEASURED))
        self._count = np.zeros(1)
        self._asked, self._asked_count = np.empty((expected_steps, 14)), np.zeros(1)
        self._made = Recording(np.empty((0, COLUMNS)))

    def make_memory(self) -> RecordedSteps:
        """Return what `record` works on, with room for further steps."""
        if self._steps == len(self._rows):
            self._rows = _double(self._rows, self._steps)
            self._asked = _double(self._asked, int(self._asked_count[0]))
        return RecordedSteps(self._rows, self._count, self._truth)

    def make_references(self, rows: Array, path: Array, base: Pose, greatest: Array, steps: Array) -> SampledReference:
        """Return what `put_reference` works on, at most once for each step that there is room for."""
        return SampledReference(rows, path, base, greatest, steps, self._asked, self._asked_count)

    @property
    def _steps(self) -> int:
        return int(self._count[0])

    def mean_force_n(self, since: float) -> float:
        """Return the mean normal force in N of the steps from `since` in s on, 0 if there is none."""
        rows = self._rows[: self._steps]
        first = int(np.searchsorted(rows[:, 0], since))
        return float(rows[first:, 1].mean()) if first < len(rows) else 0.0

    def recording(self) -> Recording:
        """Return a read-only copy of the recording; references are interpolated between samples.

        It is made once for all who ask between two steps.
        """
        if len(self._made.rows) == self._steps:
            return self._made
        rows = np.empty((self._steps, COLUMNS))
        rows[:, :MEASURED] = self._rows[: self._steps]
        if (asked := self._asked[: int(self._asked_count[0])]).size:
            for column, values in enumerate(asked[:, 1:].T, start=MEASURED):
                rows[:, column] = np.interp(rows[:, 0], asked[:, 0], values)
        rows.flags.writeable = False
        self._made = Recording(rows)
        return self._made


def _double(rows: Array, filled: int) -> Array:
    """Return twice as many rows (n, m), of which the first ones are as here; the others are no memory yet."""
    more = np.empty((2 * len(rows), rows.shape[1]))
    more[:filled] = rows[:filled]
    return more
