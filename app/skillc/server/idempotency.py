"""The same request twice is one operation: keys of requests, with the operation that each has started."""

from __future__ import annotations

import asyncio
import sqlite3
import time
from collections.abc import AsyncIterator, Set
from contextlib import asynccontextmanager
from hashlib import sha256

from skillc.cells.database import transaction

TABLE = """
CREATE TABLE requests (
    who       TEXT NOT NULL,                   -- the name of a token
    key       TEXT NOT NULL,                   -- Idempotency-Key
    hash      BLOB NOT NULL,                   -- SHA-256 of cell and body
    operation TEXT NOT NULL,
    wall_ns   INTEGER NOT NULL,
    PRIMARY KEY (who, key)
) WITHOUT ROWID
"""


class KeyReused(Exception):
    """A key was used for another request before."""


class RequestKeys:
    """The keys in the database of a server."""

    def __init__(self, database: sqlite3.Connection) -> None:
        self._database = database
        self._waiting: dict[tuple[str, str], tuple[asyncio.Lock, int]] = {}

    @asynccontextmanager
    async def alone(self, who: str, key: str) -> AsyncIterator[None]:
        """Let requests with the same key wait for each other, in a `with` statement."""
        lock, count = self._waiting.get((who, key), (asyncio.Lock(), 0))
        self._waiting[who, key] = lock, count + 1
        try:
            async with lock:  # wait ends: with the answer to the request before, which the cell or its end gives
                yield
        finally:
            lock, count = self._waiting.pop((who, key))
            if count > 1:
                self._waiting[who, key] = lock, count - 1

    def claim(self, who: str, key: str, content: bytes, operation: str) -> str:
        """Return the operation for a request: `operation` if its key is new, else that of the first request with it.

        KeyReused if the first request was another one.
        """
        hashed = sha256(content).digest()
        row = (who, key, hashed, operation, time.time_ns())
        self._database.execute("INSERT OR IGNORE INTO requests VALUES (?, ?, ?, ?, ?)", row)
        query = "SELECT hash, operation FROM requests WHERE who = ? AND key = ?"
        found, first = self._database.execute(query, (who, key)).fetchone()
        if found != hashed:
            raise KeyReused(f"the key `{key}` was used for another request before; use a new one")
        return str(first)

    def release(self, who: str, key: str) -> None:
        """Forget a key whose request was refused, so that it can be repeated."""
        self._database.execute("DELETE FROM requests WHERE who = ? AND key = ?", (who, key))

    def forget(self, operations: Set[str]) -> None:
        """Forget the keys of the requests that started operations."""
        rows = self._database.execute("SELECT who, key, operation FROM requests")
        found = [(who, key) for who, key, operation in rows if operation in operations]
        with transaction(self._database):
            self._database.executemany("DELETE FROM requests WHERE who = ? AND key = ?", found)
