"""The state folder of a server: its database, its lock, and a folder for each cell."""

from __future__ import annotations

import os
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path

from skillc.cells.database import DatabaseError, Schema, describe_error, open_for_writing
from skillc.client.address import ADDRESS, ADMIN_TOKEN, read_token
from skillc.errors import ServiceError
from skillc.server.access.audit import TABLE as AUDIT
from skillc.server.access.sessions import TABLE as SESSIONS
from skillc.server.access.sessions import Sessions
from skillc.server.access.tokens import PREFIX, Tokens
from skillc.server.access.tokens import TABLE as TOKENS
from skillc.server.idempotency import TABLE as REQUESTS
from skillc.server.jobs.store import JOB_EVENTS, JOBS, SERIES, TRIALS, add_jobs
from skillc.server.orders.store import TABLE as ORDERS
from skillc_runtime.store.store_lock import StoreLock


def _add_orders(database: sqlite3.Connection) -> None:
    database.execute(ORDERS)


def _add_trials(database: sqlite3.Connection) -> None:
    database.execute(SERIES)
    database.execute(TRIALS)


def _add_sessions(database: sqlite3.Connection) -> None:
    database.execute(SESSIONS)


def _add_agents(database: sqlite3.Connection) -> None:
    database.execute("ALTER TABLE tokens ADD COLUMN agent INTEGER NOT NULL DEFAULT 0")


TABLES = (TOKENS, AUDIT, REQUESTS, ORDERS, SESSIONS, JOBS, JOB_EVENTS)
MIGRATIONS = {1: _add_orders, 2: _add_trials, 3: _add_sessions, 4: _add_agents, 5: add_jobs}
SCHEMA = Schema(6, ";\n".join(TABLES), MIGRATIONS)
LOCK, DATABASE, CELLS, JOB_FILES = "lock", "server.sqlite", "cells", "jobs"
ADMIN = "admin"
"""The name of the token that the command line uses by itself."""


@dataclass(frozen=True, slots=True)
class ServerState:
    """What a server keeps in its folder; `database` is in autocommit mode, and durable.

    `token_file` has the token of the command line.
    """

    folder: Path
    database: sqlite3.Connection
    token_file: Path

    def describe(self, error: DatabaseError | sqlite3.Error) -> str:
        """Return an error of a database as a sentence that says what to do."""
        return str(error if isinstance(error, DatabaseError) else describe_error(self.folder / DATABASE, error))

    @property
    def tokens(self) -> Tokens:
        """The tokens of clients."""
        return Tokens(self.database)

    @property
    def sessions(self) -> Sessions:
        """The sessions of browsers."""
        return Sessions(self.database)


@contextmanager
def open_state(folder: Path, token_file: Path | None = None) -> Iterator[ServerState]:
    """Open or create a state folder, which no other server uses meanwhile.

    At the first start it gets a token for the command line, in a file that only its owner can read: `token_file`, by
    default `admin.token` in the folder. ServiceError if another server uses it, or that file has something else;
    DatabaseError or OSError if it cannot be used.
    """
    folder.mkdir(parents=True, exist_ok=True, mode=0o700)
    (folder / LOCK).touch(mode=0o600)
    lock = StoreLock(folder / LOCK)
    try:
        if not lock.try_exclusive():
            raise ServiceError(f"{folder} is in use by {lock.describe_others()}; two servers cannot share it")
        with closing(open_for_writing(folder / DATABASE, SCHEMA)) as database:
            state = ServerState(folder, database, token_file or folder / ADMIN_TOKEN)
            _ensure_admin_token(state)
            yield state
    finally:
        lock.release()


@contextmanager
def announced(state: ServerState, address: str) -> Iterator[None]:
    """Let the state folder have the address of its server in a `with` statement."""
    file = state.folder / ADDRESS
    file.write_text(f"{address}\n", encoding="ascii")
    try:
        yield
    finally:
        file.unlink(missing_ok=True)


def _ensure_admin_token(state: ServerState) -> None:
    """Make the token of the command line unless its file has the one that is known."""
    token = read_token(state.token_file)
    if token is not None and state.tokens.find(token) is not None:
        return
    is_free = not state.token_file.exists() or token == "" or (token or "").startswith(PREFIX)
    if not is_free:
        raise ServiceError(f"{state.token_file} has something else than a token; name another file, or remove it")
    state.tokens.revoke(ADMIN)
    half = state.token_file.with_name(f"{state.token_file.name}.half")
    half.unlink(missing_ok=True)
    with os.fdopen(os.open(half, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w", encoding="ascii") as file:
        file.write(state.tokens.add(ADMIN, "admin") + "\n")
    half.replace(state.token_file)
