"""An append-only file of transactions that several processes write; a line counts only if it is complete.

A file beside it has the number of the last one that was written, so that a file which lost its end is not taken for an
older one. It may lag behind after a loss of power, but is never ahead.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from zlib import crc32

import msgspec

from skillc_runtime.cancellation import CancelToken
from skillc_runtime.platforms.file_locks import read_at, unlock, write_at
from skillc_runtime.store.file_lock import lock_file
from skillc_runtime.store.store_lock import PATIENCE_S, describe_holders
from skillc_runtime.world.state.transactions import StoreError

LAST = "last"
"""The file with the number of the last transaction."""


class JournalEntry(msgspec.Struct, frozen=True, array_like=True):
    """A stored transaction: its changes as JSON, the triples it removes and adds, as N-Triples, and who wrote it."""

    sequence: int
    origin: str
    changes: str
    removed: str
    added: str
    author: str = ""


@dataclass(frozen=True, slots=True)
class _Position:
    """A position between two lines: the number of the transaction before it and the offset in bytes."""

    sequence: int
    offset: int


class TransactionJournal:
    """The transactions after those in the facts folder.

    A line is a checksum, an entry as JSON and the end of line. An incomplete last line, which a crashed writer left, is
    ignored, and the next writer removes it. A complete line with a wrong checksum is reported as damage, and so are
    fewer transactions than were written.
    """

    def __init__(self, path: Path, cancel: CancelToken | None = None) -> None:
        """Open or create the file; `cancel` ends all waits for other processes. OSError when it cannot be opened."""
        self._path, self._cancel = path, cancel or CancelToken()
        self.writable = os.access(path if path.exists() else path.parent, os.W_OK)
        flags = os.O_RDWR | os.O_CREAT if self.writable else os.O_RDONLY
        self._file = os.open(path, flags, 0o666)
        self._last = path.with_name(LAST)
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
            self.note_last(entry.sequence)
        return True

    def note_last(self, sequence: int) -> None:
        """Note the number of the last transaction that is on the disk; nothing where that cannot be written."""
        digits = b"%d" % sequence
        with suppress(OSError), self._last.open("r+b" if self._last.exists() else "wb") as file:
            file.write(b"%08x %s\n" % (crc32(digits), digits))

    def since(self, sequence: int) -> tuple[JournalEntry, ...]:
        """Return the entries after number `sequence`; StoreError when the file is damaged, or ends too early."""
        last, found = self._read_last(), tuple[JournalEntry, ...]()
        if sequence != self._seen.sequence or os.fstat(self._file).st_size != self._seen.offset:
            with self.locked(shared=True):
                found = self._after(sequence)
        if self._seen.sequence < last:
            raise StoreError(
                f"{self._path} ends after transaction {self._seen.sequence}, but {last} were written: files were "
                f"damaged or replaced; restore the folder from a copy, or remove {self._last} to continue with the rest"
            )
        return found

    def clear(self) -> None:
        """Remove all entries; only while no other process uses the file."""
        os.ftruncate(self._file, 0)
        os.fsync(self._file)

    def restart(self) -> None:
        """Remove all entries and count from the beginning; only while no other process uses the file."""
        self._last.unlink(missing_ok=True)
        self.clear()

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

    def _read_last(self) -> int:
        """Return the number of the last transaction as far as it is noted, which is a lower bound."""
        try:
            return _number_in(self._last.read_bytes())
        except OSError:
            return 0

    def _end(self) -> _Position:
        positions = [position for _, position in self._lines(self._seen)]
        return positions[-1] if positions else self._seen

    def _lines(self, position: _Position) -> Iterator[tuple[JournalEntry, _Position]]:
        """Yield the complete entries after a position, each with the position after it."""
        offset, sequence = position.offset, position.sequence
        size = os.fstat(self._file).st_size
        if size < offset:
            raise StoreError(f"{self._path} was shortened while it was in use; restore the folder from a copy")
        *lines, _unfinished = read_at(self._file, size - offset, offset).split(b"\n")
        for line in lines:
            entry = _entry(line)
            if entry is None or not (entry.sequence == sequence + 1 or entry.sequence <= self._start.sequence):
                raise StoreError(
                    f"{self._path} is damaged from byte {offset} on, after transaction {sequence}; "
                    f"to continue with what is before it, shorten the file to {offset} bytes and remove {self._last}"
                )
            offset, sequence = offset + len(line) + 1, max(entry.sequence, self._start.sequence)
            yield entry, _Position(sequence, offset)


def _number_in(line: bytes) -> int:
    """Return the number that `note_last` wrote in a line; 0 when it is damaged."""
    checksum, _, digits = line.rstrip(b"\n").partition(b" ")
    return int(digits) if digits.isdigit() and len(digits) < 19 and checksum == b"%08x" % crc32(digits) else 0


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
