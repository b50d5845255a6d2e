"""Sessions of browsers: a cookie in the place of a token, which no script can read."""

from __future__ import annotations

import sqlite3
import time
from dataclasses import dataclass
from hashlib import sha256
from secrets import token_urlsafe

from skillc.server.access.tokens import Client

SECRET_BYTES = 32
LIFETIME_S = 12 * 3600
"""How long a session lasts, in s."""
MAX_OF_TOKEN = 100
"""How many sessions a token has; one more ends the oldest one."""

TABLE = """
CREATE TABLE sessions (
    hash    BLOB PRIMARY KEY,                  -- SHA-256 of what the cookie holds, which has 256 random bits
    token   BLOB NOT NULL,                     -- the hash of the token that it stands for
    ends_ns INTEGER NOT NULL
) WITHOUT ROWID
"""


@dataclass(frozen=True, slots=True)
class Sessions:
    """The sessions in the state of a server; each ends with its token, too."""

    database: sqlite3.Connection

    def begin(self, token: bytes) -> str:
        """Begin a session for the token with a hash; return its secret, which cannot be read again."""
        secret, now_ns = token_urlsafe(SECRET_BYTES), time.time_ns()
        self._forget(token, now_ns)
        row = (_hash(secret), token, now_ns + LIFETIME_S * 1_000_000_000)
        self.database.execute("INSERT INTO sessions (hash, token, ends_ns) VALUES (?, ?, ?)", row)
        return secret

    def end(self, secret: str) -> None:
        """End a session."""
        self.database.execute("DELETE FROM sessions WHERE hash = ?", (_hash(secret),))

    def find(self, secret: str) -> Client | None:
        """Return whose session it is; None if it has ended, or its token was revoked.

        The hash of the secret is looked up, so the time that it takes tells nothing about other sessions.
        """
        row = self.database.execute(
            "SELECT name, role, tokens.hash, agent FROM sessions JOIN tokens ON tokens.hash = token "
            "WHERE sessions.hash = ? AND ends_ns > ?",
            (_hash(secret), time.time_ns()),
        ).fetchone()
        return Client(row[0], row[1], row[2], bool(row[3])) if row is not None else None

    def _forget(self, token: bytes, now_ns: int) -> None:
        """Remove the sessions that have ended, those of revoked tokens, and those of a token beyond the newest ones."""
        self.database.execute(
            "DELETE FROM sessions WHERE ends_ns <= ? OR token NOT IN (SELECT hash FROM tokens) OR hash IN "
            "(SELECT hash FROM sessions WHERE token = ? ORDER BY ends_ns DESC LIMIT -1 OFFSET ?)",
            (now_ns, token, MAX_OF_TOKEN - 1),
        )


def _hash(secret: str) -> bytes:
    return sha256(secret.encode()).digest()
