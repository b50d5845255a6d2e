"""The tables of the journal of a cell."""

from __future__ import annotations

import sqlite3

from skillc.cells.database import Schema

_CELL_STATE = """CREATE TABLE cell_state (
    name  TEXT PRIMARY KEY,
    value BLOB NOT NULL
) WITHOUT ROWID"""
_UNFINISHED = "CREATE INDEX unfinished_operations ON operations (submitted_ns) WHERE ended IS NULL"
_CHECKPOINTS = """CREATE TABLE checkpoints (
    name        TEXT PRIMARY KEY,
    description BLOB NOT NULL,                  -- CellCheckpoint as JSON
    content     BLOB NOT NULL                   -- SavedCell as MessagePack
) WITHOUT ROWID"""


def _add_cell_state(connection: sqlite3.Connection) -> None:
    connection.execute(_CELL_STATE)
    connection.execute("ALTER TABLE transactions ADD COLUMN written_ns INTEGER NOT NULL DEFAULT 0")


def _add_index_of_unfinished(connection: sqlite3.Connection) -> None:
    connection.execute(_UNFINISHED)


def _add_checkpoints(connection: sqlite3.Connection) -> None:
    connection.execute(_CHECKPOINTS)


SCHEMA = Schema(
    format=4,
    tables=f"""{_CELL_STATE};
{_CHECKPOINTS};
CREATE TABLE operations (
    id           TEXT PRIMARY KEY,
    submitted_ns INTEGER NOT NULL,              -- wall time, ns since 1970-01-01 UTC
    request      BLOB NOT NULL,                 -- OperationRequest as JSON
    ended        BLOB                           -- OperationStatus as JSON at its end; NULL before
) WITHOUT ROWID;
CREATE INDEX operations_by_time ON operations (submitted_ns);
{_UNFINISHED};
CREATE TABLE events (
    operation TEXT NOT NULL,
    sequence  INTEGER NOT NULL,                 -- from 1 without gaps in each operation
    envelope  BLOB NOT NULL,                    -- Envelope as JSON
    PRIMARY KEY (operation, sequence)
) WITHOUT ROWID;
CREATE TABLE transactions (
    sequence INTEGER PRIMARY KEY,               -- the number of the write in the store of the world
    origin   TEXT NOT NULL,
    evidence TEXT,                              -- how the facts are known; NULL for what a person states
    changes  TEXT NOT NULL,                     -- store/change_json.py
    undo     TEXT NOT NULL,                     -- the changes that lead back to the version before
    written_ns INTEGER NOT NULL DEFAULT 0       -- wall time, ns since 1970-01-01 UTC; 0 if it is not known
)
""",
    migrations={1: _add_cell_state, 2: _add_index_of_unfinished, 3: _add_checkpoints},
)
