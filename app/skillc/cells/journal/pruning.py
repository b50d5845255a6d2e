"""Forgets old operations of a journal, also while its cell writes to it; the world and its evidence stay."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path

from skillc.cells.database import describe_error, open_for_writing
from skillc.cells.journal.schema import SCHEMA

BATCH = 20
"""How many operations one transaction removes: the cell can write in between."""


def prune_journal(
    path: Path, before_ns: int | None, max_bytes: int | None, count_other_bytes: Callable[[], int] = lambda: 0
) -> Iterator[str]:
    """Remove operations that have ended, the oldest first, and yield their ids.

    It removes those that were submitted before `before_ns`, a wall time in ns since 1970-01-01 UTC, and as many more as
    are needed until the journal and `count_other_bytes()`, of what else there is, use at most `max_bytes`. The file
    keeps its size; what is free in it is used again.
    DatabaseError if it cannot be written.
    """
    with closing(open_for_writing(path, SCHEMA)) as database:
        while removed := _remove_batch(path, database, before_ns, max_bytes, count_other_bytes):
            yield from removed


def _remove_batch(
    path: Path,
    database: sqlite3.Connection,
    before_ns: int | None,
    max_bytes: int | None,
    count_other_bytes: Callable[[], int],
) -> tuple[str, ...]:
    limit = None if max_bytes is None else max_bytes - count_other_bytes()
    try:
        database.execute("BEGIN IMMEDIATE")
        try:
            removed = _find_oldest(database, before_ns, limit)
            database.executemany("DELETE FROM events WHERE operation = ?", [(each,) for each in removed])
            database.executemany("DELETE FROM operations WHERE id = ?", [(each,) for each in removed])
            database.execute("COMMIT")
        except BaseException:
            database.execute("ROLLBACK")
            raise
    except sqlite3.Error as error:
        raise describe_error(path, error) from error
    return removed


def _find_oldest(database: sqlite3.Connection, before_ns: int | None, max_bytes: int | None) -> tuple[str, ...]:
    too_large = max_bytes is not None and _count_used_bytes(database) > max_bytes
    query = "SELECT id, submitted_ns FROM operations WHERE ended IS NOT NULL ORDER BY submitted_ns LIMIT ?"
    rows = database.execute(query, (BATCH,)).fetchall()
    return tuple(
        name for name, submitted_ns in rows if too_large or (before_ns is not None and submitted_ns < before_ns)
    )


def _count_used_bytes(database: sqlite3.Connection) -> int:
    pages, free, size = (
        database.execute(f"PRAGMA {each}").fetchone()[0] for each in ("page_count", "freelist_count", "page_size")
    )
    return int((pages - free) * size)
