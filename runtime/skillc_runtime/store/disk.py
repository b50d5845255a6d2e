"""A store in a folder: facts in pyoxigraph and, until they are moved there, the latest transactions in a journal.

A write costs one line and one flush of the journal, whatever the size of the world. Whoever is alone with the store,
when opening or closing it, moves the journal into the facts.
"""

from __future__ import annotations

import contextlib
import shutil
from collections.abc import Iterable
from pathlib import Path

import pyoxigraph as ox

from skillc_runtime.store import facts_folder as base
from skillc_runtime.store.change_json import decode_changes, encode_changes
from skillc_runtime.store.journal import JournalEntry, TransactionJournal
from skillc_runtime.store.store import StoredWorld
from skillc_runtime.store.store_lock import StoreLock
from skillc_runtime.store.triples import triple_difference
from skillc_runtime.world.state.transactions import ChangeEvent, StoreError, Transaction

FORMAT = "skillc store, format 1\n"
MARK, LOCK, JOURNAL, FACTS = "skillc-store", "lock", "journal", "facts"


class DiskStore:
    """A world kept in a folder that any number of processes use at the same time."""

    def __init__(self, folder: Path, reset: bool = False) -> None:
        """Open or create a store and, with `reset`, forget what it holds.

        StoreError when the folder is something else, damaged or out of reach, and when others use what is to be reset.
        """
        self._folder, self._facts = folder, folder / FACTS
        try:
            _prepare(folder)
            self._users, self._journal = StoreLock(folder / LOCK), TransactionJournal(folder / JOURNAL)
        except OSError as error:
            raise StoreError(f"the store {folder} cannot be opened: {error.strerror}") from error
        try:
            self._enter(reset)
        except StoreError:
            self._leave()
            raise

    def __str__(self) -> str:
        return str(self._folder)

    def close(self) -> None:
        """Leave the store, tidied up if nobody else uses it."""
        if self._users.try_exclusive():
            self._tidy_up()
        self._leave()

    def read(self) -> StoredWorld:
        """Return the facts as they are now."""
        kept = base.read(self._facts)
        self._journal.start_after(kept.sequence)
        entries = self._journal.since(kept.sequence)
        if not entries:
            return kept
        triples = dict.fromkeys(kept.triples)
        for triple, present in _net(entries).items():
            if present:
                triples[triple] = None
            else:
                triples.pop(triple, None)
        return StoredWorld(entries[-1].sequence, kept.beginning, tuple(triples))

    def append(self, event: ChangeEvent, after: int) -> bool:
        """Write an event as the transaction that follows `after`, or return False when there is another already."""
        change = triple_difference(event)
        if after == 0:
            return self._fill(event.origin, change.added)
        removed, added = _as_text(change.removed), _as_text(change.added)
        return self._journal.append(
            JournalEntry(after + 1, event.origin, encode_changes(event.changes), removed, added)
        )

    def since(self, sequence: int) -> tuple[Transaction, ...]:
        """Return the transactions after the one of that number, in order."""
        entries = self._journal.since(sequence)
        return tuple(Transaction(each.sequence, each.origin, decode_changes(each.changes)) for each in entries)

    def _enter(self, reset: bool) -> None:
        alone = self._users.try_exclusive()
        if reset:
            self._reset(alone)
        elif alone:
            self._tidy_up()
        self._users.acquire_shared()

    def _leave(self) -> None:
        self._journal.close()
        self._users.release()

    def _fill(self, origin: str, triples: Iterable[ox.Triple]) -> bool:
        with self._journal.locked():
            if self._facts.exists():
                return False
            base.create(self._facts, triples, 1, origin)
        self._journal.start_after(1)
        return True

    def _reset(self, alone: bool) -> None:
        if not alone:
            raise StoreError(f"{self._folder} cannot be reset while {self._users.describe_others()} uses it")
        try:
            self._journal.clear()
            if self._facts.exists():
                shutil.rmtree(self._facts)
        except OSError as error:
            raise StoreError(f"{self._folder} cannot be reset: {error.strerror}") from error

    def _tidy_up(self) -> None:
        """Move the journal into the facts, where possible: what is damaged or full is told by whoever needs it."""
        if not (self._journal.writable and self._facts.exists()):
            return
        with contextlib.suppress(StoreError, OSError):
            before = base.sequence(self._facts)
            self._journal.start_after(before)
            entries = self._journal.since(before)
            if entries:
                net = _net(entries)
                removed, added = ([t for t, present in net.items() if present is wanted] for wanted in (False, True))
                base.advance(self._facts, removed, added, before, entries[-1].sequence)
            self._journal.clear()


def _prepare(folder: Path) -> None:
    """Make a folder a store, unless it is one; StoreError when it is something else, OSError when out of reach."""
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
        raise StoreError(f"{folder} is no store: it holds {', '.join(others[:3])}; name a new or an empty folder")
    (folder / LOCK).touch()
    half = folder / f"{MARK}.half"
    half.write_text(FORMAT, encoding="utf-8")
    half.replace(mark)


def _net(entries: Iterable[JournalEntry]) -> dict[ox.Triple, bool]:
    """Return the triples that entries write, in the end there or not."""
    net: dict[ox.Triple, bool] = {}
    for entry in entries:
        net.update(dict.fromkeys(_triples(entry.removed), False))
        net.update(dict.fromkeys(_triples(entry.added), True))
    return net


def _as_text(triples: Iterable[ox.Triple]) -> str:
    return "".join(f"{triple} .\n" for triple in triples)


def _triples(text: str) -> Iterable[ox.Triple]:
    return (quad.triple for quad in ox.parse(text, format=ox.RdfFormat.N_TRIPLES)) if text else ()
