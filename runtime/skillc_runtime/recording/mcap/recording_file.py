"""Writes a run to an MCAP file while it goes on, in a thread: the loop of the cell never waits for the disk."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from queue import Empty, Full, Queue
from threading import Event, Thread
from typing import TypeAlias

from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.mcap.contents import CLOSE_S, RunContents
from skillc_runtime.recording.mcap.mcap_stream import McapStream, Metadata
from skillc_runtime.recording.mcap.sample_layout import SampledBlock
from skillc_runtime.recording.mcap.signal_tap import RecordedCell

MAX_EVENTS, MAX_BLOCKS = 100_000, 200
"""How many items, and how many blocks of samples among them, may wait for the disk; with more the recording ends."""

FLUSH_S = 0.5
"""What was recorded is in the file after this wall time in s: a process that is killed loses no more."""


class _End:
    """Nothing more is recorded."""


Item: TypeAlias = Envelope | SampledBlock | Metadata | _End


class RecordingFile:
    """A recorder that writes events, and samples while it has any, to an MCAP file.

    An error never stops the robot: the recording ends then, and `problem` says why. `close` completes the file.
    """

    def __init__(self, path: Path, describe: Callable[[], RunContents], cell: RecordedCell | None = None) -> None:
        """Create the file or truncate it, and start the thread; OSError if that fails.

        `describe` is called in the thread, which leaves the processor to the loop for FLUSH_S first. Without a `cell`
        there are no samples.
        """
        self.path = path
        self.problem: str | None = None
        self._file = path.open("wb")
        self._describe, self._cell = describe, cell
        self._queue: Queue[Item] = Queue(MAX_EVENTS)
        self._ended = self._samples = False
        self._blocks_given = self._blocks_taken = 0
        self._began, self._is_urgent = time.monotonic(), Event()
        self._thread = Thread(target=self._run, name="recording", daemon=True)
        self._thread.start()

    def __call__(self, envelope: Envelope) -> None:
        """Record an event."""
        self._put(envelope)

    def add_metadata(self, metadata: Metadata) -> None:
        """Record what has turned out about the run."""
        self._put(metadata)

    def sample(self, wanted: bool = True) -> None:
        """Record the signals from now on, or no more."""
        if self._cell is None or wanted == self._samples or self._ended:
            return
        self._samples = wanted
        tap = self._cell.tap
        (tap.add if wanted else tap.remove)(self._put_block)

    def end(self) -> None:
        """Record no more; what waits is written, and the file completed, in the thread. Idempotent."""
        if self._ended:
            return
        self.sample(False)
        self._ended = True
        self._is_urgent.set()
        with suppress(Full):  # the thread ends when nothing is left
            self._queue.put_nowait(_End())

    @property
    def is_complete(self) -> bool:
        """Whether nothing is left to write."""
        return not self._thread.is_alive()

    def close(self, timeout_s: float = CLOSE_S) -> None:
        """End the recording, and wait until the file is complete, for at most `timeout_s` s of wall time."""
        self.end()
        self._thread.join(timeout_s)
        if self._thread.is_alive():
            self._give_up("the disk does not answer")

    def _put_block(self, block: SampledBlock) -> None:
        self._blocks_given += 1
        if self._blocks_given - self._blocks_taken > MAX_BLOCKS:
            self._give_up("the disk is too slow")
        self._put(block)

    def _put(self, item: Envelope | SampledBlock | Metadata) -> None:
        if self._ended or self.problem is not None:
            return
        try:
            self._queue.put_nowait(item)
        except Full:
            self._give_up("the disk is too slow")

    def _give_up(self, why: str) -> None:
        if self.problem is None:
            self.problem = f"{self.path} is incomplete: {why}"

    def _run(self) -> None:
        """Write until the end; after an error only take what comes."""
        self._is_urgent.wait(FLUSH_S)
        with self._guarded(), self._file:
            stream = McapStream(self._file, self._describe(), self._cell)
            self._write(stream)
            stream.finish()
        while not self._ended:
            self._take()

    def _write(self, stream: McapStream) -> None:
        flushed = self._began
        while not isinstance(item := self._take(), _End):
            if item is not None:
                stream.add(item)
                self._blocks_taken += isinstance(item, SampledBlock)
            if time.monotonic() - flushed >= FLUSH_S:
                stream.flush()
                flushed = time.monotonic()

    def _take(self) -> Item | None:
        """Return what waits longest; None if nothing comes for a while."""
        try:
            return self._queue.get(timeout=FLUSH_S)
        except Empty:
            return _End() if self._ended else None

    @contextmanager
    def _guarded(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            self._give_up(error.strerror or str(error))
        except Exception as error:  # noqa: BLE001  the thread's boundary: the run goes on
            self._give_up(f"{type(error).__name__}: {error}")
