"""Recordings to test with."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from skillc_runtime.recording.envelope import Recorder
from skillc_runtime.recording.events import FORMAT, Event, Note, TaskEnded, TaskStarted
from skillc_runtime.recording.mcap.contents import RunContents
from skillc_runtime.recording.mcap.recording_file import RecordingFile
from skillc_runtime.recording.publisher import Publisher

CONTENTS = RunContents({"task": "rest"}, {"library.json": b"{}"}, b'{"type": "object"}')
EVENTS: Sequence[Event] = (
    TaskStarted(time=0.0, format=FORMAT, task="rest"),
    *(Note(time=0.1 * number, message=f"note {number}") for number in range(1, 40)),
    TaskEnded(time=4.0, task="rest", status="succeeded"),
)


def publish(events: Sequence[Event], *recorders: Recorder) -> None:
    """Give events to recorders."""
    publisher = Publisher("rest-1", recorders)
    for event in events:
        publisher(event)


def write_recording(path: Path, events: Sequence[Event] = EVENTS) -> RecordingFile:
    """Write a recording without signals, with a chunk for every few events."""
    recording = RecordingFile(path, lambda: CONTENTS)
    publish(events, recording)
    recording.close()
    return recording
