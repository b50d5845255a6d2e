"""A store in a folder: facts in pyoxigraph, and the latest transactions in a journal until they are moved there.

A write costs one line and one flush of the journal, for a world of any size. A process that opens or closes the store
as its only user moves the journal into the facts.
"""

from __future__ import annotations

import contextlib
import shutil
from collections.abc import Iterable
from pathlib import Path

import pyoxigraph as ox

from skillc_runtime.cancellation import CancelToken
from skillc_runtime.store import facts_folder
from skillc_runtime.store.change_json import decode_changes, encode_changes
from skillc_runtime.store.journal import JournalEntry, TransactionJournal
from skillc_runtime.store.owner import StoreOwnership
from skillc_runtime.store.store import StoredWorld
from skillc_runtime.store.store_lock import StoreLock
from skillc_runtime.store.triples import triple_difference
from skillc_runtime.store.world_index import IndexPlace
from skillc_runtime.world.state.transactions import ChangeEvent, StoreError, Transaction

FORMAT = "skillc store, format 1\n"
MARK, LOCK, OWNER, JOURNAL, FACTS, INDEX = "skillc-store", "lock", "owner", "journal", "facts", "index"


class DiskStore:
    """A world in a folder, for any number of processes at the same time; if it has an owner, only that one writes."""

    def __init__(
        self,
        folder: Path,
        reset: bool = False,
        cancel: CancelToken | None = None,
        owner: str | None = None,
        author: str = "",
    ) -> None:
        """Open or create a store; with `reset`, delete its contents. `cancel` ends all waits for other processes.

        With `owner`, the name of who opens it, nobody else writes to it until it is closed. `author` is noted with
        each write, for others.
        StoreError when the folder is not a store, is damaged or not accessible, has another owner, or is to be reset
        while others use it.
        """
        self._folder, self._facts, self._cancel = folder, folder / FACTS, cancel or CancelToken()
        self._author = author
        self._ownership = StoreOwnership(folder / OWNER)
        try:
            _prepare(folder)
            self._lock, self._journal = StoreLock(folder / LOCK), TransactionJournal(folder / JOURNAL, self._cancel)
        except OSError as error:
            raise StoreError(f"the store {folder} cannot be opened: {error.strerror}") from error
        try:
            if owner is not None:
                self._ownership.acquire(owner, self._cancel)
            self._join(reset)
        except StoreError:
            self._leave()
            raise

    def __str__(self) -> str:
        return str(self._folder)

    def close(self) -> None:
        """Close the store; the last user moves the journal into the facts."""
        if self._lock.try_exclusive():
            self._compact()
        self._leave()

    def read(self) -> StoredWorld:
        """Return the current facts."""
        stored = facts_folder.read(self._facts)
        self._journal.start_after(stored.sequence)
        entries = self._journal.since(stored.sequence)
        if not entries:
            return stored
        triples = dict.fromkeys(stored.triples)
        for triple, present in _net_changes(entries).items():
            if present:
                triples[triple] = None
            else:
                triples.pop(triple, None)
        return StoredWorld(entries[-1].sequence, stored.beginning, tuple(triples))

    def find_index(self) -> IndexPlace | None:
        """Return where the index of the present facts is; None if there are no facts, or later transactions."""
        if not self._facts.exists():
            return None
        head = facts_folder.read_head(self._facts)
        self._journal.start_after(head.sequence)
        if self._journal.since(head.sequence):
            return None
        return IndexPlace(self._folder / INDEX, head.identity, head.sequence, head.beginning)

    def require_writable(self) -> None:
        """Raise StoreError if only somebody else may write to the store."""
        with self._ownership.writing():
            pass

    def append(self, event: ChangeEvent, after: int) -> bool:
        """Write an event as the transaction after number `after`; return False when another one has that place."""
        change = triple_difference(event)
        removed, added = _as_text(change.removed), _as_text(change.added)
        with self._ownership.writing():
            if after == 0:
                return self._fill(event.origin, change.added)
            return self._journal.append(
                JournalEntry(after + 1, event.origin, encode_changes(event.changes), removed, added, self._author)
            )

    def since(self, sequence: int) -> tuple[Transaction, ...]:
        """Return the transactions after number `sequence`, in order."""
        entries = self._journal.since(sequence)
        return tuple(
            Transaction(each.sequence, each.origin, decode_changes(each.changes), each.author) for each in entries
        )

    def _join(self, reset: bool) -> None:
        alone = self._lock.try_exclusive()
        if reset:
            self._reset(alone)
        elif alone:
            self._compact()
        self._lock.acquire_shared(self._cancel)

    def _leave(self) -> None:
        self._journal.close()
        self._lock.release()
        self._ownership.release()

    def _fill(self, origin: str, triples: Iterable[ox.Triple]) -> bool:
        with self._journal.locked():
            if self._facts.exists():
                return False
            facts_folder.create(self._facts, triples, 1, origin)
            self._journal.note_last(1)
        self._journal.start_after(1)
        return True

    def _reset(self, alone: bool) -> None:
        if not alone:
            raise StoreError(f"{self._folder} cannot be reset while {self._lock.describe_others()} uses it")
        try:
            self._journal.restart()
            if self._facts.exists():
                shutil.rmtree(self._facts)
        except OSError as error:
            raise StoreError(f"{self._folder} cannot be reset: {error.strerror}") from error

    def _compact(self) -> None:
        """Move the journal into the facts if possible; errors are left to later reads and writes, which report them."""
        if not (self._journal.writable and self._facts.exists()):
            return
        with contextlib.suppress(StoreError, OSError):
            before = facts_folder.sequence(self._facts)
            self._journal.start_after(before)
            entries = self._journal.since(before)
            if entries:
                net = _net_changes(entries)
                removed, added = ([t for t, present in net.items() if present is wanted] for wanted in (False, True))
                facts_folder.advance(self._facts, removed, added, before, entries[-1].sequence)
            self._journal.clear()


def _prepare(folder: Path) -> None:
    """Make a folder a store unless it is one; StoreError when it is something else, OSError when not accessible."""
    if folder.exists() and not folder.is_dir():
        raise StoreError(f"{folder} is a file; a store is a folder, or the address of a SPARQL server")
    folder.mkdir(parents=True, exist_ok=True)
    mark = folder / MARK
    if mark.exists():
        found = mark.read_text(encoding="utf-8", errors="replace")
        if found != FORMAT:
            raise StoreError(f"{folder} is a {found.strip()[:60]!r}, and this skillc reads {FORMAT.strip()!r}")
        return
    others = sorted(each.name for each in folder.iterdir() if each.name not in (LOCK, f"{MARK}.half"))
    if others:
        raise StoreError(f"{folder} is not a store: it holds {', '.join(others[:3])}; name a new or an empty folder")
    (folder / LOCK).touch()
    half = folder / f"{MARK}.half"
    half.write_text(FORMAT, encoding="utf-8")
    half.replace(mark)


def _net_changes(entries: Iterable[JournalEntry]) -> dict[ox.Triple, bool]:
    """Return the triples that entries write, each with whether it is there in the end."""
    net: dict[ox.Triple, bool] = {}
    for entry in entries:
        net.update(dict.fromkeys(_triples(entry.removed), False))
        net.update(dict.fromkeys(_triples(entry.added), True))
    return net


def _as_text(triples: Iterable[ox.Triple]) -> str:
    return "".join(f"{triple} .\n" for triple in triples)


def _triples(text: str) -> Iterable[ox.Triple]:
    return (quad.triple for quad in ox.parse(text, format=ox.RdfFormat.N_TRIPLES)) if text else ()


def copy_store(folder: Path, target: Path) -> None:
    """Write the present world of a store, which others may use meanwhile, as a new store; StoreError if that fails."""
    with contextlib.closing(DiskStore(folder)) as store:
        world = store.read()
    with contextlib.closing(DiskStore(target)):
        if world.sequence:
            facts_folder.create(target / FACTS, world.triples, world.sequence, world.beginning)
