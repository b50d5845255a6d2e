"""The tables of a journal in SQLite, and how a file of an older format becomes one of this."""

from __future__ import annotations

import shutil
import sqlite3
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

FORMAT = 1
"""Raised with every change of the tables or of their meaning; older files are migrated when they are opened."""

BUSY_TIMEOUT_MS = 5000
"""How long a statement waits for another connection that holds the file, in ms."""

_TABLES = """
CREATE TABLE operations (
    id           TEXT PRIMARY KEY,
    submitted_ns INTEGER NOT NULL,              -- wall time, ns since 1970-01-01 UTC
    request      BLOB NOT NULL                  -- OperationRequest as JSON
) WITHOUT ROWID;
CREATE TABLE events (
    operation TEXT NOT NULL,
    sequence  INTEGER NOT NULL,                 -- from 1 without gaps in each operation
    envelope  BLOB NOT NULL,                    -- Envelope as JSON
    PRIMARY KEY (operation, sequence)
) WITHOUT ROWID;
CREATE TABLE transactions (
    sequence INTEGER PRIMARY KEY,               -- the number of the write in the store of the world
    origin   TEXT NOT NULL,
    evidence TEXT,                              -- sensed, reported or assumed; NULL for what a person states
    changes  TEXT NOT NULL,                     -- store/change_json.py
    undo     TEXT NOT NULL                      -- the changes that lead back to the version before
);
"""

_MIGRATIONS: dict[int, Callable[[sqlite3.Connection], None]] = {}
"""For each older format the function that changes a file of it into one of the next."""


class JournalError(RuntimeError):
    """A journal that cannot be used; the message names the file, the problem and what to do."""


def open_for_writing(path: Path) -> sqlite3.Connection:
    """Open a journal, or create it; one of an older format is migrated, and a copy `NAME.format-N` kept.

    JournalError if it is of a newer format, is no journal, or cannot be written.
    """
    try:
        connection = _connect(path)
        try:
            _prepare(connection, path)
        except BaseException:
            connection.close()
            raise
        return connection
    except sqlite3.Error as error:
        raise describe_error(path, error) from error


def open_for_reading(path: Path) -> sqlite3.Connection:
    """Open a journal that another process writes; JournalError if there is none, or none of this format."""
    if not path.exists():
        raise JournalError(f"there is no journal {path}")
    try:
        connection = _connect(path)
        connection.execute("PRAGMA query_only = ON")
        found = _read_format(connection)
    except sqlite3.Error as error:
        raise describe_error(path, error) from error
    if found != FORMAT:
        connection.close()
        raise JournalError(f"{path} has the format {found}; this skillc reads {FORMAT}: let it open the journal first")
    return connection


def describe_error(path: Path, error: sqlite3.Error) -> JournalError:
    """Return the error of SQLite as one of the journal."""
    code = getattr(error, "sqlite_errorcode", 0) & 0xFF
    if code in (sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB):
        return JournalError(f"{path} is damaged ({error}); restore a backup, or move it away to begin a new one")
    if code in (sqlite3.SQLITE_FULL, sqlite3.SQLITE_IOERR):
        return JournalError(f"{path} cannot be written ({error}): free some space, or repair the disk")
    return JournalError(f"{path} cannot be used: {error}")


def _connect(path: Path) -> sqlite3.Connection:
    """Connect in autocommit mode; transactions are begun explicitly."""
    connection = sqlite3.connect(path, isolation_level=None, check_same_thread=False)
    connection.execute(f"PRAGMA busy_timeout = {BUSY_TIMEOUT_MS}")
    return connection


def _prepare(connection: sqlite3.Connection, path: Path) -> None:
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("PRAGMA synchronous = FULL")
    found = _read_format(connection)
    if found > FORMAT:
        raise JournalError(f"{path} has the format {found} of a newer skillc; this one reads up to {FORMAT}")
    if found == 0 and connection.execute("SELECT count(*) FROM sqlite_master").fetchone() != (0,):
        raise JournalError(f"{path} is a database of something else")
    if 0 < found < FORMAT:
        _copy(connection, path, found)
    connection.execute("BEGIN IMMEDIATE")
    if found == 0:
        for statement in _TABLES.split(";\n"):
            connection.execute(statement)
    for number in range(found or FORMAT, FORMAT):
        _MIGRATIONS[number](connection)
    connection.execute(f"PRAGMA user_version = {FORMAT}")
    connection.execute("COMMIT")


def _read_format(connection: sqlite3.Connection) -> int:
    (found,) = connection.execute("PRAGMA user_version").fetchone()
    return int(found)


def _copy(connection: sqlite3.Connection, path: Path, found: int) -> None:
    """Copy the database, written or not at all, before it is migrated."""
    half, kept = path.with_name(f"{path.name}.half"), path.with_name(f"{path.name}.format-{found}")
    half.unlink(missing_ok=True)
    with closing(sqlite3.connect(half)) as copy:
        connection.backup(copy)
    shutil.move(half, kept)
