"""An append-only file of transactions that several processes write; a line counts only if it is complete."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from zlib import crc32

import msgspec

from skillc_runtime.cancellation import CancelToken
from skillc_runtime.platforms.file_locks import read_at, unlock, write_at
from skillc_runtime.store.file_lock import lock_file
from skillc_runtime.store.store_lock import PATIENCE_S, describe_holders
from skillc_runtime.world.state.transactions import StoreError


class JournalEntry(msgspec.Struct, frozen=True, array_like=True):
    """A stored transaction: its changes as JSON, and the triples it removes and adds, as N-Triples."""

    sequence: int
    origin: str
    changes: str
    removed: str
    added: str


@dataclass(frozen=True, slots=True)
class _Position:
    """A position between two lines: the number of the transaction before it and the offset in bytes."""

    sequence: int
    offset: int


class TransactionJournal:
    """The transactions after those in the facts folder.

    A line is a checksum, an entry as JSON and the end of line. An incomplete last line, which a crashed writer left, is
    ignored, and the next writer removes it. A complete line with a wrong checksum is reported as damage.
    """

    def __init__(self, path: Path, cancel: CancelToken | None = None) -> None:
        """Open or create the file; `cancel` ends all waits for other processes. OSError when it cannot be opened."""
        self._path, self._cancel = path, cancel or CancelToken()
        self.writable = os.access(path if path.exists() else path.parent, os.W_OK)
        flags = os.O_RDWR | os.O_CREAT if self.writable else os.O_RDONLY
        self._file = os.open(path, flags, 0o666)
        self._start = self._seen = _Position(0, 0)

    def start_after(self, sequence: int) -> None:
        """Read from the first line, ignoring transactions up to number `sequence`, which are stored elsewhere."""
        self._start = self._seen = _Position(sequence, 0)

    def close(self) -> None:
        """Close the file."""
        os.close(self._file)

    def append(self, entry: JournalEntry) -> bool:
        """Write an entry to the disk; return False when another one has its number. StoreError when writing fails.

        An entry that cannot be written completely is removed.
        """
        if not self.writable:
            raise StoreError(f"{self._path} is read-only here, so nothing can be written to the store")
        with self.locked():
            position = self._end()
            if position.sequence + 1 != entry.sequence:
                return False
            try:
                os.ftruncate(self._file, position.offset)
                self._seen = _Position(entry.sequence, position.offset + self._write(_line(entry), position.offset))
            except OSError as error:
                self._truncate(position)
                raise StoreError(f"nothing can be written to {self._path}: {error.strerror}") from error
        return True

    def since(self, sequence: int) -> tuple[JournalEntry, ...]:
        """Return the entries after number `sequence`; StoreError when the file is damaged."""
        if sequence == self._seen.sequence and os.fstat(self._file).st_size <= self._seen.offset:
            return ()
        with self.locked(shared=True):
            return self._after(sequence)

    def clear(self) -> None:
        """Remove all entries; only while no other process uses the file."""
        os.ftruncate(self._file, 0)
        os.fsync(self._file)

    @contextmanager
    def locked(self, shared: bool = False) -> Iterator[None]:
        """Lock the file: exclusively, or shared, so that no process writes.

        StoreError when other processes lock it for PATIENCE_S.
        """
        if not lock_file(self._file, shared, self._cancel.limited(PATIENCE_S)):
            raise StoreError(f"{self._path} is locked by {describe_holders(self._file)}; try again later")
        try:
            yield
        finally:
            unlock(self._file)

    def _after(self, sequence: int) -> tuple[JournalEntry, ...]:
        position = self._seen if self._seen.sequence <= sequence else self._start
        found: list[JournalEntry] = []
        for entry, end in self._lines(position):
            self._seen = end
            if entry.sequence > sequence:
                found.append(entry)
        return tuple(found)

    def _write(self, line: bytes, offset: int) -> int:
        done = 0
        while done < len(line):
            done += write_at(self._file, line[done:], offset + done)
        os.fsync(self._file)
        return done

    def _truncate(self, position: _Position) -> None:
        """Remove an incomplete line; if that fails, it stays and is ignored."""
        try:
            os.ftruncate(self._file, position.offset)
        except OSError:
            return

    def _end(self) -> _Position:
        positions = [position for _, position in self._lines(self._seen)]
        return positions[-1] if positions else self._seen

    def _lines(self, position: _Position) -> Iterator[tuple[JournalEntry, _Position]]:
        """Yield the complete entries after a position, each with the position after it."""
        offset, sequence = position.offset, position.sequence
        size = os.fstat(self._file).st_size
        if size <= offset:
            return
        *lines, _unfinished = read_at(self._file, size - offset, offset).split(b"\n")
        for line in lines:
            entry = _entry(line)
            if entry is None or not (entry.sequence == sequence + 1 or entry.sequence <= self._start.sequence):
                raise StoreError(
                    f"{self._path} is damaged from byte {offset} on, after transaction {sequence}; "
                    f"to continue with what is before it, shorten the file to {offset} bytes"
                )
            offset, sequence = offset + len(line) + 1, max(entry.sequence, self._start.sequence)
            yield entry, _Position(sequence, offset)


def _line(entry: JournalEntry) -> bytes:
    text = msgspec.json.encode(entry)
    return b"%08x %s\n" % (crc32(text), text)


def _entry(line: bytes) -> JournalEntry | None:
    """Return the entry of a line, None when the line is damaged."""
    checksum, _, text = line.partition(b" ")
    if checksum != b"%08x" % crc32(text):
        return None
    try:
        return msgspec.json.decode(text, type=JournalEntry)
    except msgspec.DecodeError:
        return None
