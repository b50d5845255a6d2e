"""The standard streams as the commands see them: closed ones stand open, and a refusal to print has a name."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TextIO, cast


class OutputError(Exception):
    """The standard output takes nothing more; `reason` is what the system says."""

    def __init__(self, reason: OSError) -> None:
        super().__init__(f"cannot write to the standard output: {reason.strerror or reason}")
        self.reason = reason


class _Stream:
    """A text stream whose refusals to write go to `refused`."""

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
def guarded() -> Iterator[None]:
    """Raise OutputError where the standard output cannot be written to; messages that cannot be written are dropped.

    A standard input that is closed is empty. A standard output that is closed can be written to no more than a full
    one, but nothing else is opened in its place.
    """
    sys.stdin = sys.stdin or _nowhere(os.O_RDONLY, "r")
    sys.stdout = sys.stdout or _nowhere(os.O_RDONLY, "w")
    sys.stderr = sys.stderr or _nowhere(os.O_WRONLY, "w")
    before = sys.stdout, sys.stderr
    sys.stdout = cast(TextIO, _Stream(sys.stdout, _raise))
    sys.stderr = cast(TextIO, _Stream(sys.stderr, lambda _: close(before[1])))
    try:
        try:
            yield
        finally:
            if not sys.stdout.closed:
                sys.stdout.flush()
    except OutputError:
        close(before[0])
        raise
    finally:
        sys.stdout, sys.stderr = before


def close(stream: TextIO) -> None:
    """Send what is still to be written to a stream nowhere."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, stream.fileno())
    os.close(nowhere)


def _raise(error: OSError) -> None:
    raise OutputError(error) from error


def _nowhere(flags: int, mode: str) -> TextIO:
    """Open the null device as text; for reading only although it is to be written to, every write is refused."""
    return cast(TextIO, os.fdopen(os.open(os.devnull, flags), mode, encoding="utf-8"))
