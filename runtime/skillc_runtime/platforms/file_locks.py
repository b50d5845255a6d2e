"""Locks of open files between processes, which the system releases when a process ends, and access at an offset."""

from __future__ import annotations

import os
import sys
from pathlib import Path

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

HAS_SHARED_LOCKS = sys.platform != "win32"
"""Whether several processes can hold a lock that excludes others: Windows only offers exclusive ones to C programs."""

_LOCKED_BYTE = 2**40
"""Windows locks bytes, which nobody else can read meanwhile: one far behind the end of the file."""


def try_lock(file: int, shared: bool = False) -> bool:
    """Lock an open file exclusively, or shared, if no other process prevents it; return whether that succeeded."""
    try:
        if sys.platform == "win32":
            _lock_byte(file, msvcrt.LK_NBLCK)
        else:
            fcntl.flock(file, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    return True


def unlock(file: int) -> None:
    """Release the lock of an open file."""
    if sys.platform == "win32":
        _lock_byte(file, msvcrt.LK_UNLCK)
    else:
        fcntl.flock(file, fcntl.LOCK_UN)


def find_holders(file: int) -> tuple[int, ...]:
    """Return the other processes that lock an open file; none where the system does not tell."""
    try:
        locks = Path("/proc/locks").read_text(encoding="ascii")
    except OSError:
        return ()
    inode = os.fstat(file).st_ino
    found = {int(words[4]) for words in map(str.split, locks.splitlines()) if words[5:6] and _inode(words[5]) == inode}
    return tuple(sorted(found - {os.getpid(), -1}))


def read_at(file: int, count: int, offset: int) -> bytes:
    """Read from an open file at an offset in bytes."""
    if sys.platform == "win32":
        os.lseek(file, offset, os.SEEK_SET)
        return os.read(file, count)
    return os.pread(file, count, offset)


def write_at(file: int, data: bytes, offset: int) -> int:
    """Write to an open file at an offset in bytes; return how many bytes were written."""
    if sys.platform == "win32":
        os.lseek(file, offset, os.SEEK_SET)
        return os.write(file, data)
    return os.pwrite(file, data, offset)


def _inode(device: str) -> int:
    """Return the inode in `major:minor:inode`; -1 for other texts."""
    last = device.rpartition(":")[2]
    return int(last) if last.isdigit() else -1


if sys.platform == "win32":

    def _lock_byte(file: int, how: int) -> None:
        before = os.lseek(file, 0, os.SEEK_CUR)
        os.lseek(file, _LOCKED_BYTE, os.SEEK_SET)
        try:
            msvcrt.locking(file, how, 1)
        finally:
            os.lseek(file, before, os.SEEK_SET)
