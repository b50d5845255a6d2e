"""An append-only file of transactions that several processes write to, each line whole or not there."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from zlib import crc32

import msgspec

from skillc_runtime.world.state.transactions import StoreError


class JournalEntry(msgspec.Struct, frozen=True, array_like=True):
    """A transaction as it is written: its changes, and the triples it takes away and adds, in N-Triples."""

    sequence: int
    origin: str
    changes: str
    removed: str
    added: str


@dataclass(frozen=True, slots=True)
class _Place:
    """A place between two lines: the number of the transaction before it and the bytes up to it."""

    sequence: int
    offset: int


class TransactionJournal:
    """The transactions that follow those which are kept elsewhere.

    A line is a checksum, an entry as JSON and the end of the line. It counts once it is complete: what a writer that
    died left behind is cut off by the next one. A complete line with a wrong checksum is damage, which is told.
    """

    def __init__(self, path: Path) -> None:
        """Open the file, create it if there is none; OSError when that is impossible."""
        self._path = path
        self.writable = os.access(path if path.exists() else path.parent, os.W_OK)
        flags = os.O_RDWR | os.O_CREAT if self.writable else os.O_RDONLY
        self._file = os.open(path, flags | os.O_CLOEXEC, 0o666)
        self._start = self._seen = _Place(0, 0)

    def start_after(self, sequence: int) -> None:
        """Read from the first line on; what goes up to the transaction of that number is kept elsewhere."""
        self._start = self._seen = _Place(sequence, 0)

    def close(self) -> None:
        """Close the file."""
        os.close(self._file)

    def append(self, entry: JournalEntry) -> bool:
        """Write an entry to the disk, or return False when another has its number; StoreError when it cannot be kept.

        An entry that could not be written in full is taken back.
        """
        if not self.writable:
            raise StoreError(f"{self._path} is read-only here, so nothing can be written to the store")
        with self.locked():
            place = self._end()
            if place.sequence + 1 != entry.sequence:
                return False
            try:
                os.ftruncate(self._file, place.offset)
                self._seen = _Place(entry.sequence, place.offset + self._write(_line(entry), place.offset))
            except OSError as error:
                self._take_back(place)
                raise StoreError(f"nothing can be written to {self._path}: {error.strerror}") from error
        return True

    def since(self, sequence: int) -> tuple[JournalEntry, ...]:
        """Return the entries after the one of that number; StoreError when the file is damaged."""
        if sequence == self._seen.sequence and os.fstat(self._file).st_size <= self._seen.offset:
            return ()
        with self.locked(fcntl.LOCK_SH):
            return self._after(sequence)

    def clear(self) -> None:
        """Forget all entries; only while nobody else uses the file."""
        os.ftruncate(self._file, 0)
        os.fsync(self._file)

    @contextmanager
    def locked(self, how: int = fcntl.LOCK_EX) -> Iterator[None]:
        """Keep others from writing, or with LOCK_SH only see to it that nobody is writing."""
        fcntl.flock(self._file, how)
        try:
            yield
        finally:
            fcntl.flock(self._file, fcntl.LOCK_UN)

    def _after(self, sequence: int) -> tuple[JournalEntry, ...]:
        place = self._seen if self._seen.sequence <= sequence else self._start
        found: list[JournalEntry] = []
        for entry, end in self._lines(place):
            self._seen = end
            if entry.sequence > sequence:
                found.append(entry)
        return tuple(found)

    def _write(self, line: bytes, offset: int) -> int:
        done = 0
        while done < len(line):
            done += os.pwrite(self._file, line[done:], offset + done)
        os.fsync(self._file)
        return done

    def _take_back(self, place: _Place) -> None:
        """Cut off a line that was begun; where even that fails it stays incomplete and does not count."""
        try:
            os.ftruncate(self._file, place.offset)
        except OSError:
            return

    def _end(self) -> _Place:
        places = [place for _, place in self._lines(self._seen)]
        return places[-1] if places else self._seen

    def _lines(self, place: _Place) -> Iterator[tuple[JournalEntry, _Place]]:
        """Yield the complete entries from a place on, each with the place after it."""
        offset, sequence = place.offset, place.sequence
        size = os.fstat(self._file).st_size
        if size <= offset:
            return
        *lines, _unfinished = os.pread(self._file, size - offset, offset).split(b"\n")
        for line in lines:
            entry = _entry(line)
            if entry is None or not (entry.sequence == sequence + 1 or entry.sequence <= self._start.sequence):
                raise StoreError(
                    f"{self._path} is damaged from byte {offset} on, after transaction {sequence}; "
                    f"to go on with what is before it, shorten the file to {offset} bytes"
                )
            offset, sequence = offset + len(line) + 1, max(entry.sequence, self._start.sequence)
            yield entry, _Place(sequence, offset)


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
