"""Copies the state of a server while it runs, and puts a copy in the place of a state that nobody uses."""

from __future__ import annotations

import shutil
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from datetime import UTC, datetime
from pathlib import Path

from skillc.cells.database import DatabaseError, describe_error, require_sound
from skillc.cells.settings import WORLD
from skillc.client.address import ADMIN_TOKEN
from skillc.errors import RequestError, ServiceError
from skillc.server.state import CELLS, DATABASE, LOCK
from skillc_runtime.store.disk import copy_store
from skillc_runtime.store.store_lock import StoreLock
from skillc_runtime.world.state.transactions import StoreError


def back_up(state: Path, target: Path) -> None:
    """Copy a state folder, also while a server uses it, to a folder that does not exist; it appears complete or not.

    Of each cell the world is copied first, then the journal: it has all that the world has, and the cell catches up.
    RequestError if there is no state, or the target exists; ServiceError if something is damaged, or cannot be read or
    written.
    """
    if not (state / DATABASE).exists():
        raise RequestError(f"{state} is not the state of a server: it has no {DATABASE}")
    if target.exists():
        raise RequestError(f"{target} exists; name a new folder")
    half = target.with_name(f"{target.name}.half")
    with _writing(target):
        shutil.rmtree(half, ignore_errors=True)
        half.mkdir(parents=True, mode=0o700)
        _copy_database(state / DATABASE, half / DATABASE)
        if (state / ADMIN_TOKEN).exists():
            shutil.copy2(state / ADMIN_TOKEN, half / ADMIN_TOKEN)
        for cell in sorted((state / CELLS).glob("*")):
            _copy_cell(cell, half / CELLS / cell.name)
        half.rename(target)


def restore(backup: Path, state: Path) -> Path | None:
    """Put a copy of a backup in the place of a state; return where the former state is now, None if there was none.

    RequestError if the backup is none, or a server uses the state; ServiceError if something in the backup is damaged,
    or cannot be written: the state stays as it is.
    """
    if not (backup / DATABASE).exists():
        raise RequestError(f"{backup} is not a backup of a server: it has no {DATABASE}")
    half = state.with_name(f"{state.name}.half")
    with _writing(state):
        shutil.rmtree(half, ignore_errors=True)
        shutil.copytree(backup, half)
        for each in sorted(half.rglob("*.sqlite")):
            _require_sound(each, backup / each.relative_to(half))
        if not state.exists():
            half.rename(state)
            return None
        with _unused(state):
            former = state.with_name(f"{state.name}.until-{datetime.now(UTC):%Y%m%dT%H%M%SZ}")
            state.rename(former)
            half.rename(state)
    return former


def _copy_cell(cell: Path, target: Path) -> None:
    """Copy the folder of a cell: its world, then its journal, then all other files."""
    target.mkdir(parents=True)
    if (cell / WORLD).exists():
        copy_store(cell / WORLD, target / WORLD)
    for file in sorted(cell.rglob("*")):
        name = file.relative_to(cell)
        if name.parts[0] == WORLD or not file.is_file() or file.suffix in (".sqlite-wal", ".sqlite-shm"):
            continue
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        if file.suffix == ".sqlite":
            _copy_database(file, target / name)
        else:
            shutil.copy2(file, target / name)


def _copy_database(source: Path, target: Path) -> None:
    """Copy a database as it is after its last transaction; others may write to it meanwhile.

    ServiceError if it is damaged, or cannot be read or written.
    """
    with _reading(source), closing(sqlite3.connect(source)) as database, closing(sqlite3.connect(target)) as copy:
        database.backup(copy)
        require_sound(copy, source)


def _require_sound(copy: Path, source: Path) -> None:
    """ServiceError if the copy of a database is damaged, since the one at `source` is."""
    with _reading(source), closing(sqlite3.connect(copy)) as database:
        require_sound(database, source)


@contextmanager
def _reading(database: Path) -> Iterator[None]:
    """Turn errors of a database in a `with` statement into ServiceError."""
    try:
        yield
    except DatabaseError as error:
        raise ServiceError(str(error)) from error
    except sqlite3.Error as error:
        raise ServiceError(str(describe_error(database, error))) from error


@contextmanager
def _unused(state: Path) -> Iterator[None]:
    """Keep servers away from a state in a `with` statement; RequestError if one uses it."""
    (state / LOCK).touch(mode=0o600)
    lock = StoreLock(state / LOCK)
    try:
        if not lock.try_exclusive():
            raise RequestError(f"{state} is in use by {lock.describe_others()}; end the server first")
        yield
    finally:
        lock.release()


@contextmanager
def _writing(target: Path) -> Iterator[None]:
    """Turn errors of files in a `with` statement into ServiceError."""
    try:
        yield
    except StoreError as error:
        raise ServiceError(str(error)) from error
    except OSError as error:
        raise ServiceError(f"{target} cannot be written: {error}") from error
