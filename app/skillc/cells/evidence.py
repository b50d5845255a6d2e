"""The evidence for the facts of a cell, kept so that a cell with a long history starts as quickly as a new one."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from skillc.cells.database import DatabaseError
from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import JournalledWrite, JournalReader
from skillc_runtime.store.change_json import decode_changes, encode_changes
from skillc_runtime.world.state.evidence import EvidenceLedger, UndoableWrite
from skillc_runtime.world.state.facts import Evidence
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState

MERGED = "evidence"
"""The name of the merged writes in the journal."""
PERIOD = 1000
"""After how many writes those that the ledger has merged are saved again."""


class StoredWrite(msgspec.Struct, frozen=True):
    """A write with the evidence for its facts; `undo` leads back to the version before."""

    evidence: Evidence | None
    origin: str
    changes: str
    undo: str


class MergedWrites(msgspec.Struct, frozen=True):
    """All writes up to `sequence` as one, as the ledger keeps them; `undo` leads back to the scene.

    After a restore, the last of these writes are kept one by one, in `separate`.
    """

    sequence: int
    evidence: Evidence | None
    origin: str
    changes: str
    undo: str
    separate: tuple[StoredWrite, ...] = ()


class EvidenceKeeper:
    """Saves in the journal which writes the ledger of a world has merged: those need not be read again."""

    def __init__(self, world: WorldModel, journal: CellJournal, reader: JournalReader) -> None:
        saved = read_merged(reader)
        self._world, self._journal = world, journal
        self._sequence = saved.sequence if saved is not None else 0

    def keep(self) -> None:
        """Add the merged writes to the next commit if that is due."""
        world, ledger = self._world, self._world.ledger
        if world.sequence - self._sequence < PERIOD or (merged := ledger.merged) is None:
            return
        self._sequence = world.sequence - ledger.separate
        write = merged.undoable
        changes, undo = encode_changes(write.changes), encode_changes(write.undo)
        saved = MergedWrites(self._sequence, write.evidence, write.origin, changes, undo)
        self._journal.set_state(MERGED, msgspec.msgpack.encode(saved))

    def replace(self, writes: Sequence[UndoableWrite], origin: str) -> None:
        """Replace the evidence by that of `writes`, the last of which led to the present version of the world.

        All other facts are given by a person, as `origin` says.
        """
        world = self._world
        world.ledger = EvidenceLedger()
        world.ledger.restore(world.snapshot(), writes)
        self._sequence = world.sequence
        keep_as_given(self._journal, world.sequence, origin, tuple(map(store_write, writes)))


def store_write(write: UndoableWrite) -> StoredWrite:
    """Return a write for a file."""
    return StoredWrite(write.evidence, write.origin, encode_changes(write.changes), encode_changes(write.undo))


def read_write(stored: StoredWrite) -> UndoableWrite:
    """Return a stored write; ValueError if it cannot be read."""
    return UndoableWrite(stored.evidence, stored.origin, decode_changes(stored.changes), decode_changes(stored.undo))


def keep_as_given(journal: CellJournal, sequence: int, origin: str, writes: tuple[StoredWrite, ...] = ()) -> None:
    """Record that all facts after the write `sequence` were given by a person, except for those of `writes`."""
    nothing = encode_changes(())
    journal.set_state(MERGED, msgspec.msgpack.encode(MergedWrites(sequence, None, origin, nothing, nothing, writes)))


def read_merged(reader: JournalReader) -> MergedWrites | None:
    """Return the merged writes that were saved last; None if none were. DatabaseError if they cannot be read."""
    saved = reader.state(MERGED)
    try:
        return None if saved is None else msgspec.msgpack.decode(saved, type=MergedWrites)
    except msgspec.MsgspecError as error:
        raise DatabaseError(f"{reader} has evidence that cannot be read ({error}): restore a backup") from error


def restore_evidence(
    ledger: EvidenceLedger, state: WorldState, merged: MergedWrites | None, writes: Sequence[JournalledWrite]
) -> None:
    """Add the merged writes, and those after them that led to `state`, to a ledger."""
    kept = list[UndoableWrite]()
    if merged is not None:
        changes, undo = decode_changes(merged.changes), decode_changes(merged.undo)
        kept.append(UndoableWrite(merged.evidence, merged.origin, changes, undo))
        kept.extend(map(read_write, merged.separate))
    for each in writes:
        kept.append(UndoableWrite(each.evidence, each.transaction.origin, each.transaction.changes, each.undo))
    ledger.restore(state, kept)
