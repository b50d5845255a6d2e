"""Writes a run to an MCAP file while it goes on, in a thread: the loop of the cell never waits for the disk."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from queue import Empty, Full, Queue
from threading import Thread
from typing import TypeAlias

from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.mcap.contents import RunContents
from skillc_runtime.recording.mcap.mcap_stream import McapStream
from skillc_runtime.recording.mcap.signal_tap import SampledBlock, SignalTap
from skillc_runtime.recording.signals.signal import Signal

MAX_WAITING = 500
"""How many events and blocks of samples may wait for the disk; if there are more, the recording ends."""

FLUSH_S = 1.0
"""What was recorded is in the file after this wall time in s: a process that is killed loses no more."""

CLOSE_S = 20.0
"""How long the end of a recording may take, in s of wall time."""


class _End:
    """Nothing more is recorded."""


Item: TypeAlias = Envelope | SampledBlock | _End


class RecordingFile:
    """A recorder that writes events, and samples from `tap`, to an MCAP file.

    An error never stops the robot: the recording ends then, and `problem` says why. `close` completes the file.
    """

    def __init__(
        self, path: Path, contents: RunContents, tap: SignalTap | None = None, signals: tuple[Signal, ...] = ()
    ) -> None:
        """Create the file or truncate it, and start the thread; OSError if that fails. `signals` are those of `tap`."""
        self.path = path
        self.problem: str | None = None
        self._queue: Queue[Item] = Queue(MAX_WAITING)
        self._closed = False
        layout = None if tap is None else tap.layout
        self._stream = McapStream(path, contents, layout, signals)
        self._thread = Thread(target=self._run, name="recording", daemon=True)
        self._thread.start()
        self._tap = tap
        if tap is not None:
            tap.add(self._put)

    def __call__(self, envelope: Envelope) -> None:
        """Record an event."""
        self._put(envelope)

    def close(self) -> None:
        """Write what waits and complete the file; idempotent."""
        if self._closed:
            return
        if self._tap is not None:
            self._tap.remove(self._put)
        self._closed = True
        try:
            self._queue.put(_End(), timeout=CLOSE_S)
        except Full:
            self._give_up("the disk does not answer")
        self._thread.join(CLOSE_S)
        if self._thread.is_alive():
            self._give_up("the disk does not answer")

    def _put(self, item: Envelope | SampledBlock) -> None:
        if self._closed or self.problem is not None:
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
        self._guard(self._write)
        while self.problem is not None and not isinstance(self._queue.get(), _End):
            pass
        self._guard(self._stream.close)

    def _write(self) -> None:
        flushed = time.monotonic()
        while self.problem is None:
            try:
                item = self._queue.get(timeout=FLUSH_S)
            except Empty:
                item = None
            if isinstance(item, _End):
                return
            if item is not None:
                self._stream.add(item)
            if time.monotonic() - flushed >= FLUSH_S:
                self._stream.flush()
                flushed = time.monotonic()

    def _guard(self, action: Callable[[], None]) -> None:
        try:
            action()
        except OSError as error:
            self._give_up(error.strerror or str(error))
        except Exception as error:  # noqa: BLE001  the thread's boundary: the run goes on
            self._give_up(f"{type(error).__name__}: {error}")
