"""Forgets old operations of a server, with their events and recordings, and old entries of its audit log."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator, Set
from contextlib import closing, contextmanager
from pathlib import Path

from skillc.cells.database import DatabaseError, describe_error, open_for_writing
from skillc.cells.journal.pruning import prune_journal
from skillc.cells.operations.recording_files import RECORDINGS, recording_file
from skillc.cells.settings import JOURNAL
from skillc.contract.audit import AuditEntry
from skillc.errors import RequestError, ServiceError
from skillc.server.access.audit import AuditLog
from skillc.server.idempotency import RequestKeys
from skillc.server.state import CELLS, DATABASE, SCHEMA


def prune(state: Path, before_ns: int | None, max_bytes: int | None) -> dict[str, int]:
    """Forget operations that have ended, as `prune_journal` does for each cell; return how many of each cell.

    The keys of their requests are forgotten with them. RequestError if there is no state, ServiceError if it cannot be
    written.
    """
    _require_state(state)
    cells = [each for each in sorted((state / CELLS).glob("*")) if (each / JOURNAL).exists()]
    forgotten = {each.name: _prune_cell(each, before_ns, max_bytes) for each in cells}
    _forget_keys(state, {each for cell in forgotten.values() for each in cell})
    return {cell: len(operations) for cell, operations in forgotten.items()}


def prune_audit(state: Path, before_ns: int) -> int:
    """Remove the entries of the audit log before a time, and return how many; errors as of `prune`."""
    _require_state(state)
    with _opened(state) as database:
        return AuditLog(database).prune(before_ns)


def export_audit(state: Path) -> Iterator[AuditEntry]:
    """Yield the entries of the audit log in order; errors as of `prune`."""
    _require_state(state)
    with _opened(state) as database:
        yield from AuditLog(database).export()


def _require_state(state: Path) -> None:
    if not (state / DATABASE).exists():
        raise RequestError(f"{state} is not the state of a server: it has no {DATABASE}")


def _forget_keys(state: Path, operations: Set[str]) -> None:
    """Forget the keys of the requests that started operations."""
    with _opened(state) as database:
        RequestKeys(database).forget(operations)


@contextmanager
def _opened(state: Path) -> Iterator[sqlite3.Connection]:
    """Open the database of a server; ServiceError if it cannot be read or written."""
    path = state / DATABASE
    try:
        with closing(open_for_writing(path, SCHEMA)) as database:
            yield database
    except DatabaseError as error:
        raise ServiceError(str(error)) from error
    except sqlite3.Error as error:
        raise ServiceError(str(describe_error(path, error))) from error


def _prune_cell(cell: Path, before_ns: int | None, max_bytes: int | None) -> list[str]:
    """Forget operations of a cell, with their recordings; return their ids."""
    forgotten = list[str]()
    try:
        for operation in prune_journal(cell / JOURNAL, before_ns, max_bytes, lambda: _count_bytes(cell / RECORDINGS)):
            recording_file(cell, operation).unlink(missing_ok=True)
            forgotten.append(operation)
    except DatabaseError as error:
        raise ServiceError(str(error)) from error
    except OSError as error:
        raise ServiceError(f"{cell / RECORDINGS} cannot be pruned: {error.strerror or error}") from error
    return forgotten


def _count_bytes(folder: Path) -> int:
    return sum(each.stat().st_size for each in folder.glob("*")) if folder.exists() else 0
