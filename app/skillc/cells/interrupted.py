"""Ends the operations that a dead process left without an end."""

from __future__ import annotations

import time

from skillc.cells.continuing import decisions_about
from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import JournalReader, RecordedOperation
from skillc.contract.operation import OperationStatus
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import TaskEnded, TaskStarted
from skillc_runtime.recording.failure import Failure

REASON = "the process of the cell ended while it ran"


def end_interrupted(cell: str, reader: JournalReader, journal: CellJournal, ended: str = "") -> None:
    """Write the end of every operation that has none: it was interrupted, unless its last event says otherwise.

    `ended` is why its process has ended, as far as that is known. NotDurable if that cannot be written.
    """
    for operation in reader.unfinished():
        last = reader.last_sequence(operation.id)
        final = reader.envelopes(operation.id, last - 1)[-1]
        if not isinstance(final.event, TaskEnded):
            final = _interrupt(final, f"{REASON}: {ended}" if ended else REASON)
            journal.record(final)
        journal.end_operation(_describe(cell, operation, reader, final))
    journal.commit()


def _interrupt(last: Envelope, reason: str) -> Envelope:
    """Return the event that ends an operation after its last one."""
    failure = Failure(kind="interrupted", message=reason)
    ended = TaskEnded(time=last.cell_time_s, task=last.run, status="interrupted", failure=failure)
    return Envelope(run=last.run, sequence=last.sequence + 1, wall_time_ns=time.time_ns(), event=ended)


def _describe(cell: str, operation: RecordedOperation, reader: JournalReader, final: Envelope) -> OperationStatus:
    started, ended = reader.envelopes(operation.id, limit=1)[0].event, final.event
    assert isinstance(started, TaskStarted) and isinstance(ended, TaskEnded), "the first and the last event"
    return OperationStatus(
        id=operation.id,
        cell=cell,
        request=operation.request,
        state=ended.status,
        reason=ended.failure.message if ended.failure else "",
        events=final.sequence,
        verified=ended.verified,
        false_claims=ended.false_claims,
        failure=ended.failure,
        library_hash=started.hash,
        decisions=decisions_about(operation.id, reader) if ended.status == "interrupted" else (),
    )
