"""Inspects paths that a user names, rewrites files atomically, and checks that folders are writable."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Literal, NamedTuple

from skillc.errors import ServiceError
from skillc_dsl.encoding import decode, is_packed, pack, unpack

Kind = Literal["file", "folder", "missing", "unusable"]


class PathStatus(NamedTuple):
    """What is at a path. `is_what` completes a sentence that begins with the path: `is a folder`."""

    kind: Kind
    is_what: str


_BYTE_ORDER_MARK = b"\xef\xbb\xbf"
_BROKEN_LINK = PathStatus("unusable", "is a broken link")


def inspect_path(path: Path) -> PathStatus:
    """Return what is at a path; pipes, devices, broken links and invalid names are `unusable`."""
    try:
        mode = path.stat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        return _BROKEN_LINK if path.is_symlink() else PathStatus("missing", "is missing")
    except (OSError, ValueError) as error:
        if isinstance(error, OSError) and error.errno == errno.ELOOP:
            return _BROKEN_LINK
        reason = error.strerror if isinstance(error, OSError) else str(error)
        return PathStatus("unusable", f"cannot be opened: {reason}")
    if stat.S_ISREG(mode):
        return PathStatus("file", "is a file")
    return (
        PathStatus("folder", "is a folder") if stat.S_ISDIR(mode) else PathStatus("unusable", "is not a regular file")
    )


def rewrite_file(path: Path, old: str, new: str) -> None:
    """Replace the decoded text `old` of a file by `new`, atomically; line ends, byte order mark and permissions stay.

    What gzip has compressed is compressed again. ServiceError if the file has changed meanwhile or cannot be written;
    then it is not changed.
    """
    target = path.resolve()
    try:
        stored = target.read_bytes()
        content = unpack(stored)
        if decode("", content).text != old:
            raise ServiceError(f"{path} was changed by another program meanwhile; it is not overwritten")
        encoded = _encode(new, content)
        _replace(target, pack(encoded) if is_packed(stored) else encoded)
    except OSError as error:
        raise ServiceError(f"{path} cannot be written: {error.strerror}; it is unchanged") from error


def write_file(path: Path, text: str) -> None:
    """Write a file, completely or not at all, and the folders above it. ServiceError if it cannot be written."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.exists() and not path.is_file():
            path.write_text(text, encoding="utf-8")  # a pipe or a device
            return
        new = path.with_name(f".{path.name}.{os.getpid()}.new")
        try:
            new.write_text(text, encoding="utf-8", newline="\n")
            new.replace(path)
        finally:
            new.unlink(missing_ok=True)
    except OSError as error:
        raise ServiceError(f"{path} cannot be written: {error.strerror}") from error


def _encode(text: str, before: bytes) -> bytes:
    """Return the bytes of a text with the line ends and byte order mark of the file's content `before`."""
    dos = before.count(b"\r\n") > before.count(b"\n") // 2
    mac = b"\n" not in before and b"\r" in before
    content = text.replace("\n", "\r\n" if dos else "\r" if mac else "\n").encode()
    return _BYTE_ORDER_MARK + content if before.startswith(_BYTE_ORDER_MARK) else content


def _replace(target: Path, content: bytes) -> None:
    import tempfile  # most commands write nothing

    descriptor, name = tempfile.mkstemp(prefix=".skillc-", dir=target.parent)
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        Path(name).chmod(target.stat().st_mode & 0o7777)
        Path(name).replace(target)
    except OSError:
        Path(name).unlink(missing_ok=True)
        raise


@contextmanager
def writing_to(folder: Path) -> Iterator[None]:
    """Convert an OSError inside into a ServiceError: the folder cannot be written to."""
    try:
        yield
    except OSError as error:
        raise ServiceError(f"cannot write to {folder}: {error.strerror or error}") from error


def check_writable(folder: Path | None) -> None:
    """Raise ServiceError if a folder (unless None) cannot be created or written to; no files or folders remain."""
    if folder is None:
        return
    with writing_to(folder):
        missing = [each for each in (folder, *folder.parents) if not each.exists()]
        folder.mkdir(parents=True, exist_ok=True)
        import tempfile

        with tempfile.TemporaryFile(dir=folder):
            pass
        for each in missing:
            each.rmdir()
