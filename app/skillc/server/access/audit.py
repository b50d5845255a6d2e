"""The audit log: who requested what, when, from where, and with which result. Entries are never changed."""

from __future__ import annotations

import sqlite3
import time
from collections.abc import Iterator

from skillc.contract.audit import AuditEntry

TABLE = """
CREATE TABLE audit (
    number  INTEGER PRIMARY KEY AUTOINCREMENT,
    wall_ns INTEGER NOT NULL,
    who     TEXT NOT NULL,                     -- the name of a token; empty for requests without a valid one
    origin  TEXT NOT NULL,                     -- the address of the client
    action  TEXT NOT NULL,                     -- the method, the path and the body of the request, cut
    status  INTEGER NOT NULL,                  -- the status of the answer; 0 if it is not known
    detail  TEXT NOT NULL                      -- why it was refused; empty otherwise
)
"""
EXPORTED = 1000
"""How many entries are read at once."""
MAX_TEXT = 500
"""The number of characters that are kept of a text."""


class AuditLog:
    """The audit log in the database of a server."""

    def __init__(self, database: sqlite3.Connection) -> None:
        self._database = database

    def add(self, who: str, origin: str, action: str, status: int, detail: str) -> int:
        """Add an entry, and return its number; characters that are no text in one line are replaced."""
        texts = [_clean(each) for each in (who, origin, action)]
        row = (time.time_ns(), *texts, status, _clean(detail))
        query = "INSERT INTO audit (wall_ns, who, origin, action, status, detail) VALUES (?, ?, ?, ?, ?, ?)"
        number = self._database.execute(query, row).lastrowid
        assert number is not None, "a row was added"
        return number

    def complete(self, number: int, status: int, detail: str) -> None:
        """Note how the request of an entry was answered."""
        query = "UPDATE audit SET status = ?, detail = ? WHERE number = ?"
        self._database.execute(query, (status, _clean(detail), number))

    def prune(self, before_ns: int) -> int:
        """Remove the entries before a time in ns since 1970-01-01 UTC, and return how many; an entry says so."""
        count = self._database.execute("DELETE FROM audit WHERE wall_ns < ?", (before_ns,)).rowcount
        if count:
            self.add("", "", f"{count} older entries were removed", 0, "")
        return count

    def export(self) -> Iterator[AuditEntry]:
        """Yield all entries, in order."""
        last = 0
        while found := self.entries(last, EXPORTED):
            yield from found
            last = found[-1].number

    def entries(self, after: int, limit: int) -> tuple[AuditEntry, ...]:
        """Return entries after number `after`, in order."""
        columns = "number, wall_ns, who, origin, action, status, detail"
        query = f"SELECT {columns} FROM audit WHERE number > ? ORDER BY number LIMIT ?"
        return tuple(AuditEntry(*row) for row in self._database.execute(query, (after, limit)))


def _clean(text: str) -> str:
    return "".join(letter if letter.isprintable() else "\ufffd" for letter in text[:MAX_TEXT])
