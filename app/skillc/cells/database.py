"""Opens SQLite databases that survive their process and their formats, with errors that say what to do."""

from __future__ import annotations

import shutil
import sqlite3
from collections.abc import Callable, Iterator, Mapping
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

BUSY_TIMEOUT_MS = 5000
"""How long a statement waits for another connection that holds the file, in ms."""


PRIVATE = 0o600
"""The permissions of a database."""


class DatabaseError(RuntimeError):
    """A database that cannot be used; the message names the file, the problem and what to do."""


@dataclass(frozen=True, slots=True)
class Schema:
    """The tables of a database, as SQL, and their format, which is raised with every change of them.

    `migrations` has for each older format the function that changes a database of it into one of the next.
    """

    format: int
    tables: str
    migrations: Mapping[int, Callable[[sqlite3.Connection], None]] = field(default_factory=dict)


def open_for_writing(path: Path, schema: Schema) -> sqlite3.Connection:
    """Open a database, or create it, in autocommit mode; commits are durable. Only its owner can read it from then on.

    One of an older format is migrated, and a copy `NAME.format-N` kept. DatabaseError if it is damaged, is of a newer
    format, is of something else, or cannot be written; then nothing is changed.
    """
    try:
        _keep_private(path)
        connection = _connect(path)
        try:
            _prepare(connection, path, schema)
        except BaseException:
            connection.close()
            raise
        return connection
    except sqlite3.Error as error:
        raise describe_error(path, error) from error


def open_for_reading(path: Path, schema: Schema) -> sqlite3.Connection:
    """Open a database that another process writes; DatabaseError if there is none, or none of this format."""
    if not path.exists():
        raise DatabaseError(f"there is no file {path}")
    try:
        connection = _connect(path)
        connection.execute("PRAGMA query_only = ON")
        found = _read_format(connection)
    except sqlite3.Error as error:
        raise describe_error(path, error) from error
    if found != schema.format:
        connection.close()
        raise DatabaseError(f"{path} has the format {found}, and this skillc reads {schema.format}")
    return connection


@contextmanager
def transaction(connection: sqlite3.Connection) -> Iterator[None]:
    """Do what a `with` statement does together, durably, or not at all."""
    connection.execute("BEGIN IMMEDIATE")
    try:
        yield
    except BaseException:
        connection.execute("ROLLBACK")
        raise
    connection.execute("COMMIT")


def require_sound(connection: sqlite3.Connection, path: Path) -> None:
    """Read the whole database; DatabaseError if a part of it is damaged, sqlite3.Error if nothing can be read."""
    ((found,),) = connection.execute("PRAGMA quick_check(1)").fetchall()
    if found != "ok":
        raise _describe_damage(path, " ".join(str(found).split()))


def describe_error(path: Path, error: sqlite3.Error) -> DatabaseError:
    """Return an error of SQLite as one that says what to do."""
    code = getattr(error, "sqlite_errorcode", 0) & 0xFF
    if code in (sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB):
        return _describe_damage(path, str(error))
    if code in (sqlite3.SQLITE_FULL, sqlite3.SQLITE_IOERR):
        return DatabaseError(f"{path} cannot be written ({error}): free some space, or repair the disk")
    return DatabaseError(f"{path} cannot be used: {error}")


def _describe_damage(path: Path, problem: str) -> DatabaseError:
    return DatabaseError(f"{path} is damaged ({problem}); restore a backup, or move it away to begin a new one")


def _connect(path: Path) -> sqlite3.Connection:
    """Connect in autocommit mode; transactions are begun explicitly."""
    connection = sqlite3.connect(path, isolation_level=None, check_same_thread=False)
    connection.execute(f"PRAGMA busy_timeout = {BUSY_TIMEOUT_MS}")
    return connection


def _keep_private(path: Path) -> None:
    """Create an empty file, or take a file from all but its owner; SQLite makes its other files like it."""
    try:
        path.touch(mode=PRIVATE)
        path.chmod(PRIVATE)
    except OSError as error:
        raise DatabaseError(f"{path} cannot be used: {error.strerror or error}") from error


def _prepare(connection: sqlite3.Connection, path: Path, schema: Schema) -> None:
    require_sound(connection, path)
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("PRAGMA synchronous = FULL")
    found = _read_format(connection)
    if found > schema.format:
        raise DatabaseError(f"{path} has the format {found} of a newer skillc; this one reads up to {schema.format}")
    if found == 0 and connection.execute("SELECT count(*) FROM sqlite_master").fetchone() != (0,):
        raise DatabaseError(f"{path} is a database of something else")
    if 0 < found < schema.format:
        _copy(connection, path, found)
    connection.execute("BEGIN IMMEDIATE")
    if found == 0:
        for statement in schema.tables.split(";\n"):
            connection.execute(statement)
    for number in range(found or schema.format, schema.format):
        schema.migrations[number](connection)
    connection.execute(f"PRAGMA user_version = {schema.format}")
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
