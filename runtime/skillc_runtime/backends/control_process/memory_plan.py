"""Where the parts of the memory are that a control process shares with the process of the tree."""

from __future__ import annotations

from typing import Final

from skillc_runtime.backends.control_process.snapshot import SnapshotLayout
from skillc_runtime.motion.arrays import OutVector

ROWS: Final = 4000
"""Cycles that are kept for the recording: 4 s at 1 kHz."""

TIME, STAMP, LOST, LATE = range(4)
"""The first entries of a row: s of the machine's clock and of the device's, cycles lost so far, s."""

FIRST: Final = 4
"""Where the rest of a row begins: q, dq (nv,), velocity (3,), force (3,), wrench (6,), reference (24,) of `LiveArm`."""


class MemoryPlan:
    """The plan for an arm with so many joints; `size` is the number of float64.

    beat (1,): when the process of the tree was alive last, in s of the machine's clock.
    """

    def __init__(self, joints: int) -> None:
        self.layout = SnapshotLayout(joints)
        self.row_width = FIRST + 2 * joints + 3 + 3 + 6 + 24
        self._record_end = 2 + self.layout.size
        self.size = self._record_end + 1 + ROWS * self.row_width

    def beat(self, memory: OutVector) -> OutVector:
        """Return the part of the memory (size,) that the process of the tree writes."""
        return memory[:1]

    def record(self, memory: OutVector) -> OutVector:
        """Return the part for the `SharedRecord` of snapshots."""
        return memory[1 : self._record_end]

    def ring(self, memory: OutVector) -> OutVector:
        """Return the part for the `SharedRing` of rows."""
        return memory[self._record_end :]
