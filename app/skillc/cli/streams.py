"""Guards the standard streams: closed ones are replaced, and a failed write to stdout is an OutputError."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TextIO, cast

from skillc.errors import OutputError


class _Stream:
    """A text stream that calls `refused` with the error of a failed write."""

    def __init__(self, stream: TextIO, refused: Callable[[OSError], None]) -> None:
        self._stream = stream
        self._refused = refused

    def write(self, text: str) -> int:
        try:
            return self._stream.write(text)
        except OSError as error:
            self._refused(error)
            return len(text)

    def flush(self) -> None:
        try:
            self._stream.flush()
        except OSError as error:
            self._refused(error)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


@contextmanager
def guard_streams() -> Iterator[None]:
    """Raise OutputError if the standard output cannot be written to; drop messages that stderr does not take.

    A closed standard input reads as empty. A write to a closed standard output fails like one to a full disk; its file
    descriptor is taken, so that no other file is opened in its place.
    """
    sys.stdin = sys.stdin or _open_null(os.O_RDONLY, "r")
    sys.stdout = sys.stdout or _open_null(os.O_RDONLY, "w")
    sys.stderr = sys.stderr or _open_null(os.O_WRONLY, "w")
    before = sys.stdout, sys.stderr
    sys.stdout = cast(TextIO, _Stream(sys.stdout, _raise))
    sys.stderr = cast(TextIO, _Stream(sys.stderr, lambda _: discard(before[1])))
    try:
        try:
            yield
        finally:
            if not sys.stdout.closed:
                sys.stdout.flush()
    except OutputError:
        discard(before[0])
        raise
    finally:
        sys.stdout, sys.stderr = before


def discard(stream: TextIO) -> None:
    """Redirect a stream to the null device, so that its buffer is discarded."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, stream.fileno())
    os.close(nowhere)


def _raise(error: OSError) -> None:
    raise OutputError(error) from error


def _open_null(flags: int, mode: str) -> TextIO:
    """Open the null device as a text stream; opened read-only with mode "w", it refuses every write."""
    return cast(TextIO, os.fdopen(os.open(os.devnull, flags), mode, encoding="utf-8"))
