"""Reads the journal of a cell, also while its process writes to it, and from other processes."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import msgspec

from skillc.cells.database import DatabaseError, describe_error, open_for_reading
from skillc.cells.journal.schema import SCHEMA
from skillc.contract.cell import CellCheckpoint
from skillc.contract.operation import OperationRequest, OperationStatus
from skillc.errors import RequestError
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.store.change_json import decode_changes
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.facts import Evidence
from skillc_runtime.world.state.transactions import Transaction

MAX_EVENTS = 1000
"""The largest number of events that one query returns."""
LATEST_NS = 2**63 - 1
"""A wall time after all others: the clock may have been set back since something was recorded."""
LATEST_WRITE = 2**63 - 1
"""A number after those of all writes."""
_REQUESTED = ("task", "goal", "call", "owner", "continues", "arguments")
_ENDED = ("state", "failure.message")
_SEARCHED = " || ' ' || ".join(
    [
        "id",
        *(f"coalesce(json_extract(CAST(request AS TEXT), '$.{each}'), '')" for each in _REQUESTED),
        *(f"coalesce(json_extract(CAST(ended AS TEXT), '$.{each}'), '')" for each in _ENDED),
    ]
)
"""The text of an operation that words are looked for in, as SQL."""


@dataclass(frozen=True, slots=True)
class RecordedOperation:
    """An operation that was submitted, at a wall time in ns since 1970; `ended` is how it ended, None before."""

    id: str
    submitted_ns: int
    request: OperationRequest
    ended: OperationStatus | None


@dataclass(frozen=True, slots=True)
class JournalledWrite:
    """A write to the world, its evidence, and the changes that lead back to the version before it.

    It was made at the wall time `written_ns` in ns since 1970; 0 if that is not known.
    """

    transaction: Transaction
    evidence: Evidence | None
    undo: tuple[Change, ...]
    written_ns: int


class JournalReader:
    """A connection that reads a journal; every method raises DatabaseError if that is not possible."""

    def __init__(self, path: Path) -> None:
        """Open a journal; DatabaseError if there is none, or none of this format."""
        self._path = path
        self._connection = open_for_reading(path, SCHEMA)
        self._decoder = msgspec.json.Decoder(Envelope)

    def __str__(self) -> str:
        return str(self._path)

    def close(self) -> None:
        """Close the file."""
        self._connection.close()

    def unfinished(self) -> tuple[RecordedOperation, ...]:
        """Return the operations without an end, in the order of their submission."""
        return self._select("WHERE ended IS NULL ORDER BY submitted_ns, id")

    def find(self, operation: str) -> RecordedOperation | None:
        """Return the operation of this id; None if there is none."""
        found = self._select("WHERE id = ?", operation)
        return found[0] if found else None

    def latest(self, before_ns: int, limit: int, words: Sequence[str] = ()) -> tuple[RecordedOperation, ...]:
        """Return the last operations that were submitted before a wall time in ns since 1970, the last one first.

        Those in which all words occur: in the id, in what was requested and by whom, or in how it ended.
        """
        matching = f" AND instr(lower({_SEARCHED}), ?)" * len(words)
        where = f"WHERE submitted_ns < ?{matching} ORDER BY submitted_ns DESC, id LIMIT ?"
        return self._select(where, before_ns, *(each.lower() for each in words), limit)

    def envelopes(self, operation: str, after: int = 0, limit: int = MAX_EVENTS) -> tuple[Envelope, ...]:
        """Return the events of an operation after number `after`, at most `limit` of them."""
        query = "SELECT envelope FROM events WHERE operation = ? AND sequence > ? ORDER BY sequence LIMIT ?"
        with self._reading() as connection:
            rows = connection.execute(query, (operation, after, limit)).fetchall()
            return tuple(self._decoder.decode(envelope) for (envelope,) in rows)

    def continuable(self) -> tuple[RecordedOperation, ...]:
        """Return the operations that were interrupted and can be continued."""
        return self._select("WHERE json_array_length(CAST(ended AS TEXT), '$.decisions') > 0")

    def state(self, name: str) -> bytes | None:
        """Return what the cell recorded last under a name; None if it never did."""
        with self._reading() as connection:
            row = connection.execute("SELECT value FROM cell_state WHERE name = ?", (name,)).fetchone()
            return None if row is None else bytes(row[0])

    def checkpoints(self) -> tuple[CellCheckpoint, ...]:
        """Return the checkpoints of the cell, by name."""
        with self._reading() as connection:
            rows = connection.execute("SELECT description FROM checkpoints ORDER BY name").fetchall()
            return tuple(msgspec.json.decode(each, type=CellCheckpoint) for (each,) in rows)

    def checkpoint_content(self, name: str) -> bytes:
        """Return the content of a checkpoint; LookupError if there is none of this name."""
        with self._reading() as connection:
            row = connection.execute("SELECT content FROM checkpoints WHERE name = ?", (name,)).fetchone()
            if row is None:
                raise LookupError(name)
            return bytes(row[0])

    def writes(self, after: int = 0) -> tuple[JournalledWrite, ...]:
        """Return the writes to the world after a number, in order."""
        return self._select_writes("WHERE sequence > ? ORDER BY sequence", after)

    def latest_writes(self, before: int, limit: int) -> tuple[JournalledWrite, ...]:
        """Return the last writes to the world before a number, the last one first."""
        where = "WHERE sequence < ? ORDER BY sequence DESC LIMIT ?"
        return self._select_writes(where, before, limit)

    def _select_writes(self, which: str, *values: int) -> tuple[JournalledWrite, ...]:
        query = f"SELECT sequence, origin, changes, evidence, undo, written_ns FROM transactions {which}"
        with self._reading() as connection:
            return tuple(_make_write(*row) for row in connection.execute(query, values).fetchall())

    def _select(self, which: str, *values: object) -> tuple[RecordedOperation, ...]:
        with self._reading() as connection:
            rows = connection.execute(f"SELECT id, submitted_ns, request, ended FROM operations {which}", values)
            return tuple(_make_operation(*row) for row in rows.fetchall())

    @contextmanager
    def _reading(self) -> Iterator[sqlite3.Connection]:
        try:
            yield self._connection
        except sqlite3.Error as error:
            raise describe_error(self._path, error) from error
        except (msgspec.DecodeError, msgspec.ValidationError, ValueError) as error:
            raise DatabaseError(f"{self._path} has a row that cannot be read: {error}") from error


def find_checkpoint(name: str, known: Iterable[CellCheckpoint], cell: str) -> CellCheckpoint:
    """Return a checkpoint of a cell by its name; RequestError if there is none."""
    found = {each.name: each for each in known}
    if name not in found:
        raise RequestError(f"{cell} has no checkpoint {name}; there are: {', '.join(found) or 'none'}")
    return found[name]


def _make_operation(name: str, submitted_ns: int, request: bytes, ended: bytes | None) -> RecordedOperation:
    end = None if ended is None else msgspec.json.decode(ended, type=OperationStatus)
    return RecordedOperation(name, submitted_ns, msgspec.json.decode(request, type=OperationRequest), end)


def _make_write(
    sequence: int, origin: str, changes: str, evidence: Evidence | None, undo: str, written_ns: int
) -> JournalledWrite:
    transaction = Transaction(sequence, origin, decode_changes(changes))
    return JournalledWrite(transaction, evidence, decode_changes(undo), written_ns)
