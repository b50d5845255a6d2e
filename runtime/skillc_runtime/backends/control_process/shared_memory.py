"""Arrays that two processes share: one writes, the other reads without waiting for it.

A record is guarded by a counter that is odd while it is written; a reader copies it again if the counter was odd or has
changed. A ring keeps the last rows, each written before its counter. Both rely on a processor that shows writes in
their order, as x86-64 does.
"""

from __future__ import annotations

import mmap
import os
import tempfile

import numpy as np

from skillc_runtime.motion.arrays import OutMatrix, OutVector
from skillc_runtime.motion.pose import Array

TRIES = 1000
"""How often a record is copied, until it counts as left behind half written by a process that has ended."""


def make_memory(count: int) -> int:
    """Return the number of an open file without a name that holds `count` float64; child processes may inherit it."""
    with tempfile.TemporaryFile() as file:
        file.truncate(8 * count)
        return os.dup(file.fileno())


def map_memory(file: int) -> OutVector:
    """Return the array (count,) of an open file of `make_memory`, which is closed."""
    memory = mmap.mmap(file, 0)
    os.close(file)
    return np.frombuffer(memory, dtype=np.float64)


class SharedRecord:
    """An array (count,) of float64, of which a reader gets whole versions only. `memory` is (count + 1,)."""

    def __init__(self, memory: OutVector) -> None:
        self._counter, self._values = memory[:1], memory[1:]
        self._last: Array = self._values.copy()

    def write(self, values: Array) -> None:
        """Replace the values."""
        self._counter += 1.0
        self._values[:] = values
        self._counter += 1.0

    def read(self) -> Array:
        """Return a copy of the newest values; of the last whole ones if the writer has ended while it wrote."""
        for _ in range(TRIES):
            before = self._counter[0]
            copy = self._values.copy()
            if before % 2 == 0 and self._counter[0] == before:
                self._last = copy
                break
        return self._last


class SharedRing:
    """The last rows (width,) that were written. `memory` is (1 + rows * width,)."""

    def __init__(self, memory: OutVector, width: int) -> None:
        self._counter, self.width = memory[:1], width
        self._rows: OutMatrix = memory[1:].reshape(-1, width)
        self._taken = 0

    def write(self, row: Array) -> None:
        """Add a row, over the oldest one."""
        count = int(self._counter[0])
        self._rows[count % len(self._rows)] = row
        self._counter[0] = count + 1

    def take(self) -> Array:
        """Return the rows (n, width) since the last call, oldest first; those that were overwritten are left out."""
        count, size = int(self._counter[0]), len(self._rows)
        first = max(self._taken, count - size // 2)
        self._taken = count
        rows = self._rows[np.arange(first, count) % size]
        overwritten = int(self._counter[0]) - size - first
        return rows[max(0, overwritten + 1) :] if overwritten >= 0 else rows
