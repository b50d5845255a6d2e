"""Ends the operations that a dead process left without an end."""

from __future__ import annotations

import time

from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import JournalReader, RecordedOperation
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import TaskEnded
from skillc_runtime.recording.failure import Failure

REASON = "the process of the cell ended while it ran"


def end_interrupted(reader: JournalReader, journal: CellJournal) -> None:
    """Write the end of every operation that has none: it was interrupted. NotDurable if that cannot be written."""
    for operation in reader.operations():
        _end(operation, reader, journal)
    journal.commit()


def _end(operation: RecordedOperation, reader: JournalReader, journal: CellJournal) -> None:
    last = reader.last_sequence(operation.id)
    envelopes = reader.envelopes(operation.id, last - 1)
    if not envelopes or isinstance(envelopes[-1].event, TaskEnded):
        return
    before = envelopes[-1]
    failure = Failure(kind="interrupted", message=REASON)
    ended = TaskEnded(time=before.cell_time_s, task=operation.id, status="interrupted", failure=failure)
    journal.record(Envelope(run=operation.id, sequence=last + 1, wall_time_ns=time.time_ns(), event=ended))
