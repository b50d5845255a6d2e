"""Reads the envelopes of a recording one by one, so its size does not matter."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import BinaryIO

import msgspec

from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import FORMAT, Event, TaskStarted

MAX_LINE_BYTES = 1 << 24
"""The maximum length of an event; a file with a longer line is not a recording."""


class _Start(msgspec.Struct):
    """The fields that the first event has in every format."""

    type: str
    format: int = 1


class _FirstLine(msgspec.Struct):
    """The first line of a file: since format 5 an envelope with the first event, before that the event itself."""

    event: _Start


_FIRST_LINE = msgspec.json.Decoder(_FirstLine)
_START = msgspec.json.Decoder(_Start)


@cache
def _decoder() -> msgspec.json.Decoder[Envelope]:
    """Return the decoder of all events, which takes long to make."""
    return msgspec.json.Decoder(Envelope)


class TraceError(ValueError):
    """A file that is not a recording of this format; the message has the line and the reason."""


class TraceReader:
    """Yields the envelopes of a file; TraceError at a line that is not the next one of the run, OSError if unreadable.

    An incomplete last line, which a crash may leave, is skipped and sets `is_truncated`.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.is_truncated = False

    def __iter__(self) -> Iterator[Envelope]:
        self.is_truncated = False
        decoder = EnvelopeDecoder(self.path)
        with self.path.open("rb") as file:
            for number, line in enumerate(_read_lines(file), start=1):
                if line.endswith(b"\n"):
                    yield decoder.decode(line)
                elif len(line) == MAX_LINE_BYTES:
                    raise TraceError(f"{self.path}:{number}: this is not an event: the line has no end")
                else:
                    self.is_truncated = True

    @property
    def events(self) -> Iterator[Event]:
        """The events without their envelopes; raises the same errors."""
        return (envelope.event for envelope in self)


class EnvelopeDecoder:
    """Decodes the events of a run, one after the other; TraceError for what is not the next one."""

    def __init__(self, path: Path) -> None:
        """`path` is the file that messages name."""
        self._path, self._number = path, 0
        self._run: str | None = None

    def decode(self, line: bytes) -> Envelope:
        """Return the next event."""
        self._number += 1
        number, run = self._number, self._run
        if number == 1:
            self._check_format(line)
        try:
            envelope = _decoder().decode(line)
        except (msgspec.DecodeError, UnicodeDecodeError) as error:
            raise TraceError(f"{self._path}:{number}: this is not an event of skillc: {error}") from error
        if envelope.sequence != number or envelope.run != (run or envelope.run):
            found = f"event {envelope.sequence} of {envelope.run}"
            raise TraceError(f"{self._path}:{number}: event {number} of {run or 'a run'} is expected here, not {found}")
        self._run = envelope.run
        return envelope

    def _check_format(self, line: bytes) -> None:
        """Raise TraceError if the first line declares another format."""
        start = _read_start(line)
        if start is not None and start.type == TaskStarted.__struct_config__.tag and start.format != FORMAT:
            version = "a newer" if start.format > FORMAT else "an older"
            reads = f"format {start.format}; this one reads format {FORMAT}"
            raise TraceError(f"{self._path}:1: {version} skillc wrote this ({reads})")


def _read_start(line: bytes) -> _Start | None:
    """Return the first event of a file of any format; None if the line has none."""
    with suppress(msgspec.DecodeError, UnicodeDecodeError):
        return _FIRST_LINE.decode(line).event
    with suppress(msgspec.DecodeError, UnicodeDecodeError):
        return _START.decode(line)
    return None


def _read_lines(file: BinaryIO) -> Iterator[bytes]:
    while line := file.readline(MAX_LINE_BYTES):
        yield line
