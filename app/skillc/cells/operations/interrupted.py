"""Ends the operations that a dead process left without an end."""

from __future__ import annotations

from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import JournalReader, RecordedOperation
from skillc.cells.operations.continuing import decisions_about
from skillc.contract.operation import OperationStatus
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import TaskEnded, TaskStarted
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.history.account import RunAccount, to_instant

REASON = "the process of the cell ended while it ran"


def end_interrupted(cell: str, reader: JournalReader, journal: CellJournal, ended: str = "") -> None:
    """Write the end of every operation that has none: it was interrupted, unless its last event says otherwise.

    `ended` is why its process has ended, as far as that is known. NotDurable if that cannot be written.
    """
    for operation in reader.unfinished():
        account, final = _read_account(operation.id, reader)
        if not isinstance(final.event, TaskEnded):
            final = _interrupt(final, f"{REASON}: {ended}" if ended else REASON)
            journal.record(final)
            account(final)
        journal.end_operation(_describe(cell, operation, reader, final, account))
    journal.commit()


def _read_account(operation: str, reader: JournalReader) -> tuple[RunAccount, Envelope]:
    """Return what an operation has come to by its recorded events, and the last one of these."""
    account, page = RunAccount(), reader.envelopes(operation)
    last = page[-1]
    while page:
        for last in page:
            account(last)
        page = reader.envelopes(operation, last.sequence)
    return account, last


def _interrupt(last: Envelope, reason: str) -> Envelope:
    """Return the event that ends an operation after its last one, at the same time: nobody knows of a later one."""
    failure = Failure(kind="interrupted", message=reason)
    ended = TaskEnded(time=last.cell_time_s, task=last.run, status="interrupted", failure=failure)
    return Envelope(run=last.run, sequence=last.sequence + 1, wall_time_ns=last.wall_time_ns, event=ended)


def _describe(
    cell: str, operation: RecordedOperation, reader: JournalReader, final: Envelope, account: RunAccount
) -> OperationStatus:
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
        submitted_at=to_instant(operation.submitted_ns),
        started_at=account.started_at,
        ended_at=account.ended_at,
        failure=ended.failure,
        outputs=account.outputs,
        measures=account.measures,
        library_hash=started.hash,
        decisions=decisions_about(operation.id, reader) if ended.status == "interrupted" else (),
    )
