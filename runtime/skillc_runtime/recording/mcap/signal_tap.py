"""Samples the signals of a cell in each control period, for as many recordings as there are.

The loop of the cell only copies memory. What the copies mean is worked out in the threads of the recordings.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import msgspec
import numpy as np

from skillc_runtime.devices.live import LiveSignals, Places
from skillc_runtime.motion.arrays import Integers, OutMatrix, OutVector
from skillc_runtime.motion.numerics.compiled import COMPILES, bind, compiled
from skillc_runtime.motion.numerics.copying import MEMMOVE
from skillc_runtime.motion.numerics.places import call_entry
from skillc_runtime.motion.numerics.program import Rows, row_of
from skillc_runtime.recording.mcap.sample_layout import SampledBlock, SampleLayout, list_reads
from skillc_runtime.recording.signals.signal import Signal

BLOCK_S = 1.0
"""Samples of so many s of the cell are handed over at once."""

POSES_S = 0.04
"""The time between two samples of the poses of all bodies, in s of the cell: that of the pictures of a film."""


ITEM = 8
"""Bytes of a number."""

ROW, DUE = 0, 1
"""Entries of `TapMemory.counts`: rows that are filled; rows until the poses of bodies are sampled."""


class TapMemory(msgspec.Struct, frozen=True):
    """What a tap copies in machine code: places (n, 2), address and size of arrays, to the next of `rows`.

    copying (1, 2): the addresses of C's `memmove`, and of `rows`.
    """

    places: Integers
    rows: OutMatrix
    counts: OutVector
    copying: Integers


@compiled
def copy_signals(tap: TapMemory, now: float) -> int:
    """Copy what is there in one control period; return 1, and do nothing, if poses are to be sampled before."""
    counts = tap.counts
    if counts[DUE] == 0.0:
        return 1
    memmove, to = tap.copying[0, 0], tap.copying[0, 1] + ITEM * int(counts[ROW]) * tap.rows.shape[1]
    for each in range(tap.places.shape[0]):
        size = ITEM * tap.places[each, 1]
        call_entry(memmove, to, tap.places[each, 0], size)
        to += size
    counts[ROW] += 1.0
    counts[DUE] -= 1.0
    return 0


class SignalTap:
    """Samples the signals of a cell while there is somebody in `sinks`, who gets blocks and must not wait.

    Signals that have lasting places are copied in machine code: it is a part of each control period.
    """

    def __init__(self, live: LiveSignals) -> None:
        self.layout = SampleLayout(live)
        self._live, self._row_bytes = live, self.layout.row_bytes
        self._reads = (*(read for arm in live.arms for read in list_reads(arm)), live.sensors.read)
        self._per_pose = max(1, round(POSES_S / live.period_s))
        self._block_rows = max(1, round(BLOCK_S / live.period_s))
        self._sinks: list[Callable[[SampledBlock], None]] = []
        self._content, self._first_s = bytearray(), 0.0
        self._poses: list[tuple[float, bytes, bytes]] = []
        self._due = 0
        self._memory = self._make_memory() if COMPILES and live.places is not None else None

    def add(self, sink: Callable[[SampledBlock], None]) -> None:
        """Pass samples on to a sink from now on."""
        self.flush()
        self._sinks.append(sink)
        if len(self._sinks) == 1 and self._memory is not None:
            self._live.parts.append(self)
        elif len(self._sinks) == 1:
            self._live.listeners.append(self._sample)

    def remove(self, sink: Callable[[SampledBlock], None]) -> None:
        """Pass the last samples on to a sink, and no more."""
        self.flush()
        self._sinks.remove(sink)
        if not self._sinks and self._memory is not None:
            self._live.parts.remove(self)
        elif not self._sinks:
            self._live.listeners.remove(self._sample)

    def flush(self) -> None:
        """Pass on what was sampled."""
        if not (rows := self._rows):
            return
        bases = tuple(arm.base() for arm in self._live.arms)
        content = self._content if self._memory is None else self._memory.rows[:rows].tobytes()
        block = SampledBlock(self._first_s, rows, content, bases, tuple(self._poses))
        self._begin_block()
        for sink in self._sinks:
            sink(block)

    def _begin_block(self) -> None:
        self._content, self._poses, self._due = bytearray(), [], 0
        if self._memory is not None:
            self._memory.counts[:] = 0.0

    @property
    def _rows(self) -> int:
        return len(self._content) // self._row_bytes if self._memory is None else int(self._memory.counts[ROW])

    def _expect(self) -> float:
        """Return when the next sample of the block is due, in s; the present time without a block.

        The samples of a block are a period apart: where a device with its own time gets away from that, another begins.
        """
        rows = self._rows
        return self._first_s + rows * self._live.period_s if rows else self._live.now()

    @property
    def rows(self) -> Rows | None:
        """The function that copies the signals, from where they are now."""
        self._find_places()
        return row_of(self._copy)

    def step(self, now: float) -> bool:
        """Copy the signals of one control period."""
        self._find_places()
        events = self._copy(now)
        return events != 0 and self.act(events, now)

    def act(self, events: int, now: float) -> bool:
        """Sample poses, and copy the signals."""
        assert self._memory is not None
        self._sample_poses()
        self._memory.counts[DUE] = self._per_pose
        self._copy(now)
        return False

    def _make_memory(self) -> TapMemory:
        self._places: Places = ()
        places = np.zeros((sum(1 for arm in self._live.arms for _ in list_reads(arm)) + 1, 2), dtype=np.int64)
        rows = np.zeros((self._block_rows + self._per_pose, self._row_bytes // ITEM))
        copying = np.array([[int(MEMMOVE), rows.ctypes.data]])
        memory = TapMemory(places, rows, np.zeros(2), copying)
        self._copy = bind(copy_signals, memory)
        return memory

    def _find_places(self) -> None:
        assert self._memory is not None and self._live.places is not None
        if (places := self._live.places()) is not self._places:
            self._places, self._memory.places[:] = places, places

    def _sample(self) -> None:
        """Copy what is there in one control period; this is all that most periods cost."""
        if not self._due:
            self._sample_poses()
        self._due -= 1
        content = self._content
        for read in self._reads:
            content += read()

    def _sample_poses(self) -> None:
        """Copy the poses of bodies; begin another block where that is due."""
        if self._rows >= self._block_rows:
            self.flush()
        now, bodies = self._live.now(), self._live.bodies
        if abs(now - self._expect()) > self._live.period_s / 2:
            self.flush()
        if not self._rows:
            self._first_s = now
        self._due = self._per_pose
        self._poses.append((now, bodies.positions(), bodies.quaternions()))


class RecordedCell(msgspec.Struct, frozen=True):
    """What of a cell is recorded: the `signals` of a tap, and what it looks like: an `mujoco.MjModel`, or None."""

    tap: SignalTap
    signals: tuple[Signal, ...]
    model: Any | None
