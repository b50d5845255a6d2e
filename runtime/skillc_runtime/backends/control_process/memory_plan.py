"""Where the parts of the memory are that a control process shares with the process of the tree."""

from __future__ import annotations

from typing import Final

from skillc_runtime.backends.control_process.snapshot import FIELDS, FieldLayout
from skillc_runtime.motion.arrays import OutVector

ROWS: Final = 4000
"""Cycles that are kept for the recording: 4 s at 1 kHz."""

ROW: Final = {
    "time_s": "1", "stamp_s": "1", "lost": "1", "late_s": "1", "q": "n", "dq": "n", "velocity": "3", "force": "3",
    "wrench": "6", "reference": "24",
}  # fmt: skip
"""The fields of a row of the recording, as in `FIELDS` of snapshots and in `LiveArm`, with their sizes."""

TIME: Final = 0
"""Where the time of a row is in it."""


class MemoryPlan:
    """The plan for an arm with so many joints; `size` is the number of float64.

    layout: of snapshots. row: of rows of the recording.
    """

    def __init__(self, joints: int) -> None:
        self.layout, self.row = FieldLayout(FIELDS, joints), FieldLayout(ROW, joints)
        self._record_end = 2 + self.layout.size
        self.size = self._record_end + 1 + ROWS * self.row.size

    def beat(self, memory: OutVector) -> OutVector:
        """Return the part (1,) of the memory (size,) that the process of the tree writes: when it was alive last.

        In s of the machine's clock.
        """
        return memory[:1]

    def record(self, memory: OutVector) -> OutVector:
        """Return the part for the `SharedRecord` of snapshots."""
        return memory[1 : self._record_end]

    def ring(self, memory: OutVector) -> OutVector:
        """Return the part for the `SharedRing` of rows."""
        return memory[self._record_end :]
