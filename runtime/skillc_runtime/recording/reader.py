"""Reads the events of a recording one by one, so its size does not matter."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

import msgspec

from skillc_runtime.recording.events import FORMAT, Event, TaskStarted

MAX_LINE_BYTES = 1 << 24
"""The maximum length of an event; a file with a longer line is not a recording."""


class _Start(msgspec.Struct):
    """The fields that the first event has in every format."""

    type: str
    format: int = 1


_DECODER = msgspec.json.Decoder(Event)
_START = msgspec.json.Decoder(_Start)


class TraceError(ValueError):
    """A file that is not a recording of this format; the message has the line and the reason."""


class TraceReader:
    """Yields the events of a file; TraceError at a line that is not an event, OSError if it cannot be read.

    An incomplete last line, which a crash may leave, is skipped and sets `is_truncated`.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.is_truncated = False

    def __iter__(self) -> Iterator[Event]:
        self.is_truncated = False
        with self.path.open("rb") as file:
            for number, line in enumerate(_read_lines(file), start=1):
                if line.endswith(b"\n"):
                    yield self._decode(line, number)
                elif len(line) == MAX_LINE_BYTES:
                    raise TraceError(f"{self.path}:{number}: this is not an event: the line has no end")
                else:
                    self.is_truncated = True

    def _decode(self, line: bytes, number: int) -> Event:
        if number == 1:
            self._check_format(line)
        try:
            event: Event = _DECODER.decode(line)
        except (msgspec.DecodeError, UnicodeDecodeError) as error:
            raise TraceError(f"{self.path}:{number}: this is not an event of skillc: {error}") from error
        return event

    def _check_format(self, line: bytes) -> None:
        """Raise TraceError if the first line declares another format."""
        with suppress(msgspec.DecodeError, UnicodeDecodeError):
            start = _START.decode(line)
            if start.type == TaskStarted.__struct_config__.tag and start.format != FORMAT:
                version = "a newer" if start.format > FORMAT else "an older"
                reads = f"format {start.format}; this one reads format {FORMAT}"
                raise TraceError(f"{self.path}:1: {version} skillc wrote this ({reads})")


def _read_lines(file: BinaryIO) -> Iterator[bytes]:
    while line := file.readline(MAX_LINE_BYTES):
        yield line
