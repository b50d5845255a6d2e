"""The world of a cell, in a store behind the journal of the cell, as its last process left it."""

from __future__ import annotations

from collections.abc import Sequence

from skillc.cells.database import DatabaseError
from skillc.cells.evidence import read_merged, restore_evidence
from skillc.cells.journal.fingerprint import Fingerprint, read_fingerprint
from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import LATEST_WRITE, JournalledWrite, JournalReader
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.transactions import ChangeEvent, TransactionLog
from skillc_runtime.world.state.world_state import WorldState


def restore_world(
    store: TransactionLog, state: WorldState, found: Fingerprint, journal: CellJournal, reader: JournalReader
) -> WorldModel:
    """Return the world that a store and a journal keep, with the evidence for its facts.

    The store is in `state`, which has the fingerprint `found`; it gets the writes that it missed. All writes are taken
    into account: no fact that was ever assumed may count as given. DatabaseError if the store does not have the facts
    that the journal led to: nothing is written then. StoreError if the store cannot be written.
    """
    missing = _follow(state, found, reader.writes(after=found.sequence))
    reached = found
    for event in missing:
        reached = reached.after(event)
    if not _agree(reached, reader):
        raise DatabaseError(_describe_difference(store, found, reader))
    for sequence, event in enumerate(missing, found.sequence):
        if not store.append(event, sequence):
            raise DatabaseError(f"{store} was written to by others while its cell was started; start it again")
    journal.set_fingerprint(reached)
    world, merged = WorldModel(missing[-1].after if missing else state, journal, reached.sequence), read_merged(reader)
    writes = reader.writes(after=merged.sequence if merged else 0)
    restore_evidence(world.ledger, world.snapshot(), merged, writes)
    return world


def _follow(state: WorldState, found: Fingerprint, writes: Sequence[JournalledWrite]) -> Sequence[ChangeEvent]:
    """Return the writes, as far as they follow each other without a gap, as events that begin in `state`."""
    events = list[ChangeEvent]()
    for sequence, write in enumerate(writes, found.sequence + 1):
        if write.transaction.sequence != sequence:
            break
        after = state.with_changes(write.transaction.changes)
        events.append(ChangeEvent(write.transaction.changes, write.transaction.origin, state, after, None))
        state = after
    return events


def _agree(reached: Fingerprint, reader: JournalReader) -> bool:
    """Whether a world is the one that the journal led to; an old journal has no fingerprint, only numbers."""
    known, last = read_fingerprint(reader), reader.latest_writes(LATEST_WRITE, 1)
    if last and last[0].transaction.sequence != reached.sequence:
        return False
    return known is None or known == reached


def _describe_difference(store: TransactionLog, found: Fingerprint, reader: JournalReader) -> str:
    last = reader.latest_writes(LATEST_WRITE, 1)
    number = last[0].transaction.sequence if last else 1
    return (
        f"{store} does not have the facts that its cell wrote: others wrote to it, or it is another one (its last "
        f"write is {found.sequence}, that of {reader} is {number}). Restore both with `skillc state restore`, or let "
        "the cell go on with the facts in the store: `skillc state adopt CELL --why TEXT`"
    )
