"""The events of a recording, read back one after the other so that its size does not matter."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO

import msgspec

from skillc_runtime.recording.events import FORMAT, Event, TaskStarted

LONGEST_LINE = 1 << 24
"""An event takes no more bytes than this; a file with a longer line is no recording."""


class _Start(msgspec.Struct):
    """What the first event of every format says of itself."""

    type: str
    format: int = 1


_DECODER = msgspec.json.Decoder(Event)
_START = msgspec.json.Decoder(_Start)


class TraceError(ValueError):
    """A file that is no recording this version can read; the message names the line and says why."""


class TraceReader:
    """Yields the events of a file; TraceError at a line that is none, OSError when it cannot be read.

    A last line cut short by a crash is left out, and then `cut_short` is true at the end.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.cut_short = False

    def __iter__(self) -> Iterator[Event]:
        self.cut_short = False
        with self.path.open("rb") as file:
            for number, line in enumerate(_lines(file), start=1):
                if line.endswith(b"\n"):
                    yield self._event(line, number)
                elif len(line) == LONGEST_LINE:
                    raise TraceError(f"{self.path}:{number}: this is no event: the line has no end")
                else:
                    self.cut_short = True

    def _event(self, line: bytes, number: int) -> Event:
        if number == 1:
            self._check_format(line)
        try:
            event: Event = _DECODER.decode(line)
        except (msgspec.DecodeError, UnicodeDecodeError) as error:
            raise TraceError(f"{self.path}:{number}: this is no event of skillc: {error}") from error
        return event

    def _check_format(self, line: bytes) -> None:
        """Raise TraceError where the first line says that the events are of another format."""
        with suppress(msgspec.DecodeError, UnicodeDecodeError):
            start = _START.decode(line)
            if start.type == TaskStarted.__struct_config__.tag and start.format != FORMAT:
                who = "a newer" if start.format > FORMAT else "an older"
                reads = f"format {start.format}; this one reads format {FORMAT}"
                raise TraceError(f"{self.path}:1: {who} skillc wrote this ({reads})")


def _lines(file: BinaryIO) -> Iterator[bytes]:
    while line := file.readline(LONGEST_LINE):
        yield line
