"""Tokens of clients: kept as hashes, shown once."""

from __future__ import annotations

import hmac
import sqlite3
import time
from dataclasses import dataclass
from hashlib import sha256
from secrets import token_urlsafe

import msgspec

from skillc.contract.access import Role, TokenInfo

PREFIX = "skillc_"
"""What a token begins with, so that programs that search for leaked secrets find it."""
TOKEN_BYTES = 32

TABLE = """
CREATE TABLE tokens (
    name       TEXT PRIMARY KEY,
    role       TEXT NOT NULL,
    hash       BLOB NOT NULL UNIQUE,           -- SHA-256 of the token, which has 256 random bits
    created_ns INTEGER NOT NULL,
    agent      INTEGER NOT NULL                -- whether a program that decides by itself has it
) WITHOUT ROWID
"""


class Client(msgspec.Struct, frozen=True):
    """Who makes a request: the name of its token, what it may do, and the hash of the token.

    What an `agent` asks for waits for the approval of somebody else.
    """

    name: str
    role: Role
    token: bytes
    agent: bool = False


class TokenExists(Exception):
    """There is already a token of this name."""


@dataclass(frozen=True, slots=True)
class Tokens:
    """The tokens in the state of a server."""

    database: sqlite3.Connection

    def add(self, name: str, role: Role, agent: bool = False) -> str:
        """Make a token and return it: it cannot be read again. TokenExists if the name is taken."""
        token = PREFIX + token_urlsafe(TOKEN_BYTES)
        row = (name, role, _hash(token), time.time_ns(), agent)
        try:
            self.database.execute("INSERT INTO tokens VALUES (?, ?, ?, ?, ?)", row)
        except sqlite3.IntegrityError as error:
            raise TokenExists(f"there is already a token `{name}`; revoke it first, or choose another name") from error
        return token

    def list(self) -> tuple[TokenInfo, ...]:
        """Return all tokens, sorted by name."""
        rows = self.database.execute("SELECT name, role, created_ns, agent FROM tokens ORDER BY name")
        return tuple(TokenInfo(name, role, created_ns, bool(agent)) for name, role, created_ns, agent in rows)

    def revoke(self, name: str) -> bool:
        """Remove a token; return whether there was one of this name."""
        return self.database.execute("DELETE FROM tokens WHERE name = ?", (name,)).rowcount > 0

    def find(self, token: str) -> Client | None:
        """Return whose token it is; None if there is none such.

        The hash of the token is looked up, so the time that it takes tells nothing about other tokens.
        """
        return self.find_hash(_hash(token))

    def find_hash(self, hashed: bytes) -> Client | None:
        """Return whose token it is that has a hash; None if there is none such."""
        row = self.database.execute("SELECT name, role, hash, agent FROM tokens WHERE hash = ?", (hashed,)).fetchone()
        if row is None or not hmac.compare_digest(row[2], hashed):
            return None
        return Client(row[0], row[1], row[2], bool(row[3]))


def _hash(token: str) -> bytes:
    return sha256(token.encode()).digest()
