"""Appends the last event to the recording of a run that was interrupted."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import msgspec

from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import TaskEnded
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.history.history import RunHistory
from skillc_runtime.recording.history.history_builder import HistoryBuilder, listen_to
from skillc_runtime.recording.reader import TraceReader


def end_recording(path: Path, explain: Callable[[RunHistory], str], now: float) -> HistoryBuilder:
    """End a recording as `interrupted` at the time `now` of the cell in s, if it has no end, and build its history.

    `explain` returns the reason for the history up to then. An incomplete last line is removed. TraceError if the file
    is not a recording, OSError if it cannot be read or written; no other program may write to it.
    """
    reader = TraceReader(path)
    envelopes = list(reader)
    told = listen_to(envelope.event for envelope in envelopes)
    history = told.build()
    if history is None or history.status:
        return told
    last = envelopes[-1]
    ended = TaskEnded(
        time=max(now, last.cell_time_s),
        task=history.task,
        status="interrupted",
        failure=Failure(kind="interrupted", message=explain(history)),
    )
    _append(path, Envelope(run=last.run, sequence=last.sequence + 1, wall_time_ns=time.time_ns(), event=ended))
    told(ended)
    return told


def _append(path: Path, envelope: Envelope) -> None:
    """Append an envelope in place of an incomplete last line."""
    with path.open("r+b") as file:
        content = file.read()
        file.truncate(content.rfind(b"\n") + 1)
        file.seek(0, 2)
        file.write(msgspec.json.encode(envelope) + b"\n")
