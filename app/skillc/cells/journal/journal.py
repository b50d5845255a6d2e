"""Writes the journal of a cell: what happens in one tick is one transaction, durable before time passes."""

from __future__ import annotations

import sqlite3
import time
from collections import deque
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeAlias

import msgspec

from skillc.cells.database import describe_error, open_for_writing
from skillc.cells.journal.fingerprint import FINGERPRINT, Fingerprint, encode_fingerprint
from skillc.cells.journal.schema import SCHEMA
from skillc.contract.cell import CellCheckpoint
from skillc.contract.operation import OperationRequest, OperationStatus
from skillc_runtime.execution.cell_loop import NotDurable
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.store.change_json import encode_changes
from skillc_runtime.world.state.difference import changes_back
from skillc_runtime.world.state.transactions import ChangeEvent, StoreError, Transaction, TransactionLog

_INSERT_OPERATION = "INSERT INTO operations (id, submitted_ns, request) VALUES (?, ?, ?)"
_END_OPERATION = "UPDATE operations SET ended = ? WHERE id = ?"
_INSERT_EVENT = "INSERT INTO events (operation, sequence, envelope) VALUES (?, ?, ?)"
_SET_STATE = "INSERT OR REPLACE INTO cell_state (name, value) VALUES (?, ?)"
_ADD_CHECKPOINT = "INSERT INTO checkpoints (name, description, content) VALUES (?, ?, ?)"
_REMOVE_CHECKPOINT = "DELETE FROM checkpoints WHERE name = ?"
_INSERT_TRANSACTION = """INSERT INTO transactions (sequence, origin, evidence, changes, undo, written_ns)
VALUES (?, ?, ?, ?, ?, ?)"""


_Write: TypeAlias = tuple[int, ChangeEvent, int]
"""The number of a write, what it changes, and its wall time in ns since 1970."""


@dataclass(slots=True)
class _Pending:
    """What has happened since the last commit."""

    operations: list[tuple[str, int, bytes]] = field(default_factory=list)
    ended: list[tuple[bytes, str]] = field(default_factory=list)
    events: list[tuple[str, int, bytes]] = field(default_factory=list)
    writes: list[_Write] = field(default_factory=list)
    states: dict[str, bytes] = field(default_factory=dict)
    checkpoints: list[tuple[str, bytes, bytes]] = field(default_factory=list)
    removed: list[tuple[str]] = field(default_factory=list)

    def __bool__(self) -> bool:
        return any(getattr(self, each) for each in self.__slots__)


class CellJournal:
    """The journal of a cell, to which only its process writes; it is a log of its world, in front of the store.

    Events and writes to the world are collected until `commit` makes them durable together. The store of the world
    gets the writes after that, each with its number in one atomic update; `restore_world` gives it those that it missed
    when the process ended. The journal has the fingerprint of the world, so that writes of others are found.
    """

    def __init__(self, path: Path, store: TransactionLog) -> None:
        """Open or create a journal; DatabaseError if that is not possible."""
        self.path, self._store = path, store
        self._connection = open_for_writing(path, SCHEMA)
        self._encoder = msgspec.json.Encoder()
        self._pending = _Pending()
        self._not_stored: deque[_Write] = deque()
        self._fingerprint: Fingerprint | None = None

    def __str__(self) -> str:
        return str(self.path)

    def close(self) -> None:
        """Close the file; what was not committed is lost."""
        self._connection.close()

    def has_operation(self, operation: str) -> bool:
        """Whether an operation of this id was ever submitted; NotDurable if the journal cannot be read."""
        if any(each[0] == operation for each in self._pending.operations):
            return True
        try:
            return bool(self._connection.execute("SELECT 1 FROM operations WHERE id = ?", (operation,)).fetchall())
        except sqlite3.Error as error:
            raise NotDurable(str(describe_error(self.path, error))) from error

    def add_operation(self, operation: str, request: OperationRequest, submitted_ns: int) -> None:
        """Record that an operation was submitted, at a wall time in ns since 1970."""
        self._pending.operations.append((operation, submitted_ns, self._encoder.encode(request)))

    def end_operation(self, operation: OperationStatus) -> None:
        """Record how an operation has ended, after its last event."""
        self._pending.ended.append((self._encoder.encode(operation), operation.id))

    def record(self, envelope: Envelope) -> None:
        """Record an event; a recorder for the publisher of a run."""
        self._pending.events.append((envelope.run, envelope.sequence, self._encoder.encode(envelope)))

    def set_fingerprint(self, fingerprint: Fingerprint) -> None:
        """Record which facts the world has after its last write; that of later writes follows by itself."""
        self._fingerprint = fingerprint
        self.set_state(FINGERPRINT, encode_fingerprint(fingerprint))

    def set_state(self, name: str, value: bytes) -> None:
        """Record what the cell needs when it is started again, in place of what was recorded under this name."""
        self._pending.states[name] = value

    def add_checkpoint(self, checkpoint: CellCheckpoint, content: bytes) -> None:
        """Add a checkpoint with a new name."""
        self._pending.checkpoints.append((checkpoint.name, self._encoder.encode(checkpoint), content))

    def remove_checkpoint(self, name: str) -> None:
        """Remove a checkpoint."""
        self._pending.removed.append((name,))

    @property
    def has_writes(self) -> bool:
        """Whether the next commit makes writes to the world durable."""
        return bool(self._pending.writes)

    def append(self, event: ChangeEvent, after: int) -> bool:
        """Record a write to the world as the transaction after number `after`; nobody else writes."""
        self._pending.writes.append((after + 1, event, time.time_ns()))
        return True

    def since(self, sequence: int) -> tuple[Transaction, ...]:
        """Return no transactions: nobody else writes."""
        return ()

    def commit(self) -> None:
        """Make all that was recorded durable, then give the writes to the store.

        NotDurable if the journal or the store cannot be written; everything is kept then, for the next commit.
        """
        if self._pending:
            try:
                self._write(self._pending)
            except sqlite3.Error as error:
                raise NotDurable(str(describe_error(self.path, error))) from error
            except StoreError as error:
                raise NotDurable(str(error)) from error
            self._not_stored.extend(self._pending.writes)
            self._pending = _Pending()
        self._pass_on()

    def _pass_on(self) -> None:
        """Give durable writes to the store, in order."""
        while self._not_stored:
            sequence, event, _ = self._not_stored[0]
            try:
                accepted = self._store.append(event, sequence - 1)
            except StoreError as error:
                raise NotDurable(str(error)) from error
            if not accepted:
                raise NotDurable(
                    f"{self._store} was written to by others, and the cell cannot go on with it: end the cell; "
                    "what to do then is said when it starts again"
                )
            self._not_stored.popleft()

    def _write(self, pending: _Pending) -> None:
        rows = [_make_row(*each) for each in pending.writes]
        fingerprint = self._advance_fingerprint(pending)
        self._connection.execute("BEGIN IMMEDIATE")
        try:
            self._connection.executemany(_INSERT_OPERATION, pending.operations)
            self._connection.executemany(_INSERT_EVENT, pending.events)
            self._connection.executemany(_INSERT_TRANSACTION, rows)
            self._connection.executemany(_END_OPERATION, pending.ended)
            self._connection.executemany(_SET_STATE, pending.states.items())
            self._connection.executemany(_ADD_CHECKPOINT, pending.checkpoints)
            self._connection.executemany(_REMOVE_CHECKPOINT, pending.removed)
            self._connection.execute("COMMIT")
        except BaseException:
            if self._connection.in_transaction:
                self._connection.execute("ROLLBACK")
            raise
        self._fingerprint = fingerprint

    def _advance_fingerprint(self, pending: _Pending) -> Fingerprint | None:
        """Return the fingerprint after all pending writes, and let the commit record it."""
        fingerprint = self._fingerprint
        if fingerprint is None or not pending.writes:
            return fingerprint
        for _, event, _ in pending.writes:
            fingerprint = fingerprint.after(event)
        pending.states[FINGERPRINT] = encode_fingerprint(fingerprint)
        return fingerprint


def _make_row(sequence: int, event: ChangeEvent, written_ns: int) -> tuple[int, str, str | None, str, str, int]:
    undo = changes_back(event.changes, event.before, event.after)
    return sequence, event.origin, event.evidence, encode_changes(event.changes), encode_changes(undo), written_ns
