"""Writes artifacts to disk; each file is replaced atomically."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from skillc_compiler.emit.headers import COMMENTS, is_generated

HEAD_BYTES = 1000
WITH_HEADER = frozenset({*COMMENTS, ".html"})


class EmitError(OSError):
    """The artifacts could not be written; the message names the file and the reason."""


def write(
    artifacts: Mapping[str, str], directory: Path, ours: Callable[[str], bool] = is_generated
) -> tuple[Path, ...]:
    """Write the artifacts below the directory, remove those of earlier runs, and return the paths written.

    A file is only removed if `ours` accepts its beginning. EmitError if the disk is full or not writable.
    """
    written = []
    for relative, text in sorted(artifacts.items()):
        path = directory / relative
        _write_whole(path, text.encode())
        written.append(path)
    for path in _outdated(directory, set(written), ours):
        _remove(path)
    return tuple(written)


def _write_whole(path: Path, content: bytes) -> None:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        descriptor, name = tempfile.mkstemp(prefix=".skillc-", dir=path.parent)
    except OSError as error:
        raise _refused(path, error) from error
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        Path(name).chmod(0o644)
        Path(name).replace(path)
    except OSError as error:
        Path(name).unlink(missing_ok=True)
        raise _refused(path, error) from error


def _outdated(directory: Path, written: set[Path], ours: Callable[[str], bool]) -> Iterator[Path]:
    for path in sorted(directory.rglob("*")):
        if path.suffix in WITH_HEADER and path not in written and path.is_file() and ours(_head(path)):
            yield path


def _head(path: Path) -> str:
    try:
        with path.open("rb") as file:
            return file.read(HEAD_BYTES).decode(errors="replace")
    except OSError:
        return ""


def _remove(path: Path) -> None:
    try:
        path.unlink()
    except OSError as error:
        raise EmitError(f"cannot remove {path}, which is out of date: {error.strerror}") from error


def _refused(path: Path, error: OSError) -> EmitError:
    return EmitError(f"cannot write {path}: {error.strerror}; the artifacts already there are whole")
