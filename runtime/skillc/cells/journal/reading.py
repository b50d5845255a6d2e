"""Reads the journal of a cell, also while its process writes to it, and from other processes."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import msgspec

from skillc.cells.journal.schema import JournalError, describe_error, open_for_reading
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.store.change_json import decode_changes
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.evidence import Evidence
from skillc_runtime.world.state.transactions import Transaction

MAX_EVENTS = 1000
"""The largest number of events that one query returns."""


@dataclass(frozen=True, slots=True)
class RecordedOperation:
    """An operation that was submitted, at a wall time in ns since 1970, with its request as JSON."""

    id: str
    submitted_ns: int
    request: bytes


@dataclass(frozen=True, slots=True)
class JournalledWrite:
    """A write to the world, its evidence, and the changes that lead back to the version before it."""

    transaction: Transaction
    evidence: Evidence | None
    undo: tuple[Change, ...]


class JournalReader:
    """A connection that reads a journal; every method raises JournalError if that is not possible."""

    def __init__(self, path: Path) -> None:
        """Open a journal; JournalError if there is none, or none of this format."""
        self._path = path
        self._connection = open_for_reading(path)
        self._decoder = msgspec.json.Decoder(Envelope)

    def close(self) -> None:
        """Close the file."""
        self._connection.close()

    def operations(self) -> tuple[RecordedOperation, ...]:
        """Return all operations, in the order of their submission."""
        query = "SELECT id, submitted_ns, request FROM operations ORDER BY submitted_ns, id"
        with self._reading() as connection:
            return tuple(RecordedOperation(*row) for row in connection.execute(query))

    def envelopes(self, operation: str, after: int = 0, limit: int = MAX_EVENTS) -> tuple[Envelope, ...]:
        """Return the events of an operation after number `after`, at most `limit` of them."""
        query = "SELECT envelope FROM events WHERE operation = ? AND sequence > ? ORDER BY sequence LIMIT ?"
        with self._reading() as connection:
            rows = connection.execute(query, (operation, after, limit)).fetchall()
            return tuple(self._decoder.decode(envelope) for (envelope,) in rows)

    def last_sequence(self, operation: str) -> int:
        """Return the number of the last event of an operation; 0 if there is none."""
        query = "SELECT coalesce(max(sequence), 0) FROM events WHERE operation = ?"
        with self._reading() as connection:
            return int(connection.execute(query, (operation,)).fetchone()[0])

    @property
    def last_write(self) -> int:
        """The number of the last write to the world; 0 if there is none."""
        with self._reading() as connection:
            return int(connection.execute("SELECT coalesce(max(sequence), 0) FROM transactions").fetchone()[0])

    def writes(self, after: int) -> tuple[JournalledWrite, ...]:
        """Return the writes to the world after number `after`, in order."""
        query = (
            "SELECT sequence, origin, changes, evidence, undo FROM transactions WHERE sequence > ? ORDER BY sequence"
        )
        with self._reading() as connection:
            rows = connection.execute(query, (after,)).fetchall()
            return tuple(_make_write(*row) for row in rows)

    @contextmanager
    def _reading(self) -> Iterator[sqlite3.Connection]:
        try:
            yield self._connection
        except sqlite3.Error as error:
            raise describe_error(self._path, error) from error
        except (msgspec.DecodeError, msgspec.ValidationError, ValueError) as error:
            raise JournalError(f"{self._path} has a row that cannot be read: {error}") from error


def _make_write(sequence: int, origin: str, changes: str, evidence: Evidence | None, undo: str) -> JournalledWrite:
    return JournalledWrite(Transaction(sequence, origin, decode_changes(changes)), evidence, decode_changes(undo))
