"""The world of a cell, in a store behind the journal of the cell, as its last process left it."""

from __future__ import annotations

from collections.abc import Sequence

from skillc.cells.database import DatabaseError
from skillc.cells.evidence import read_merged, restore_evidence
from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import JournalledWrite, JournalReader
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.transactions import ChangeEvent, TransactionLog
from skillc_runtime.world.state.world_state import WorldState


def restore_world(
    store: TransactionLog, state: WorldState, sequence: int, journal: CellJournal, reader: JournalReader
) -> WorldModel:
    """Return the world that a store and a journal keep, with the evidence for its facts.

    The store is in `state` after the write `sequence`; it gets the writes that it missed. All writes are taken into
    account: no fact that was ever assumed may count as given. DatabaseError if store and journal do not belong
    together, StoreError if the store cannot be written.
    """
    state, sequence = _catch_up(store, state, sequence, reader.writes(after=sequence))
    world, merged = WorldModel(state, journal, sequence), read_merged(reader)
    restore_evidence(world.ledger, state, merged, reader.writes(after=merged.sequence if merged else 0))
    return world


def _catch_up(
    store: TransactionLog, state: WorldState, sequence: int, missing: Sequence[JournalledWrite]
) -> tuple[WorldState, int]:
    """Give a store, which is in `state` after the write `sequence`, the writes after it; return the same."""
    for transaction in (each.transaction for each in missing):
        if transaction.sequence != sequence + 1:
            raise DatabaseError(
                f"{store} ends with the write {sequence}, but the journal of its cell continues with "
                f"{transaction.sequence}; restore both from the same backup"
            )
        after = state.with_changes(transaction.changes)
        if not store.append(ChangeEvent(transaction.changes, transaction.origin, state, after, None), sequence):
            raise DatabaseError(f"{store} was written to by others; only its cell may write to it")
        state, sequence = after, transaction.sequence
    return state, sequence
