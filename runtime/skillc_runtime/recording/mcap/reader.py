"""Reads the MCAP file of a run, also one whose writing was cut off."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, BinaryIO

import msgspec
import numpy as np
from mcap.exceptions import McapError
from mcap.records import Attachment, Channel, McapRecord, Message, Metadata
from mcap.stream_reader import StreamReader
from zstandard import ZstdError

from skillc_runtime.motion.pose import Array
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.events import TaskEnded
from skillc_runtime.recording.mcap.contents import EVENTS, METADATA, PACKED, SIGNALS, decode_signals
from skillc_runtime.recording.mcap.signal_block import FORMAT, SignalBlock, decode_columns
from skillc_runtime.recording.reader import EnvelopeDecoder, TraceError
from skillc_runtime.recording.signals.signal import Signal

MAX_RECORD_BYTES = 1 << 30
"""The largest record of a file that is read."""

DAMAGES = (
    McapError,
    ZstdError,
    zlib.error,
    ValueError,
    struct.error,
    KeyError,
    OverflowError,
    MemoryError,
    IndexError,
    TypeError,
)
"""What the readers of a format raise for content that is not of it."""


@dataclass(frozen=True, slots=True)
class SignalTable:
    """Signals of a run: `rows` (n, m) at the times `time_s` (n,) of the cell; `signals` are the columns."""

    time_s: Array
    rows: Array
    signals: tuple[Signal, ...]

    def column(self, name: str) -> Array:
        """Return the values (n,) of the signal of that name; KeyError if there is none."""
        names = [each.column for each in self.signals]
        if name not in names:
            raise KeyError(name)
        values: Array = self.rows[:, names.index(name)]
        return values


@dataclass(frozen=True, slots=True)
class RecordedFile:
    """What is in a file. `note` says why it ends early, empty if it does not; the end of the run may be missing then.

    `metadata` and `attachments` are those of `contents`.
    """

    path: Path
    envelopes: tuple[Envelope, ...]
    metadata: Mapping[str, str]
    attachments: Mapping[str, bytes]
    note: str
    _blocks: tuple[bytes, ...] = field(repr=False)
    _about_signals: Mapping[str, str] = field(repr=False)

    @property
    def is_truncated(self) -> bool:
        """Whether the writing of the file was cut off."""
        return bool(self.note)

    def signals(self) -> SignalTable:
        """Return the signals; TraceError if they are damaged, or of another format."""
        about = self._about_signals
        try:
            if about and about["format"] != str(FORMAT):
                raise TraceError(f"{self.path}: its signals have format {about['format']}; this skillc reads {FORMAT}")
            signals = decode_signals(about["signals"]) if about else ()
            blocks = [_BLOCKS.decode(each) for each in self._blocks]
            rows = [np.empty((0, len(signals))), *map(decode_columns, blocks)]
            times = [np.empty(0), *((each.first_ns + np.arange(each.rows) * each.period_ns) / 1e9 for each in blocks)]
            return SignalTable(np.concatenate(times), np.concatenate(rows), signals)
        except TraceError:
            raise
        except DAMAGES as error:
            raise TraceError(f"{self.path} is damaged: its signals cannot be read: {error}") from error


_BLOCKS = msgspec.msgpack.Decoder(SignalBlock)


def read_recording(path: Path) -> RecordedFile:
    """Read a file; TraceError if it is not a recording, or damaged before its end; OSError if unreadable."""
    content = _Content(path)
    note = ""
    with path.open("rb") as file:
        try:
            for record in _read_records(file):
                content.take(record)
        except TraceError:
            raise
        except DAMAGES as error:
            is_at_end = not file.read(1)
            if not content.begun:
                raise TraceError(f"{path} is not a recording: it is no MCAP file") from error
            if not is_at_end:
                raise TraceError(f"{path} {content.describe_damage()}: {error or type(error).__name__}") from error
            note = f"{path} was cut off"
    if note and content.envelopes:
        last = content.envelopes[-1]
        ended = isinstance(last.event, TaskEnded)
        note += " after its last event" if ended else f"; its last event is at {last.cell_time_s:.2f} s"
    return content.make(note)


def _read_records(file: BinaryIO) -> Iterator[McapRecord]:
    yield from StreamReader(file, validate_crcs=True, record_size_limit=MAX_RECORD_BYTES).records


class _Content:
    """What was read of a file so far."""

    def __init__(self, path: Path) -> None:
        self._path, self._decoder = path, EnvelopeDecoder(path)
        self._channels: dict[int, Channel] = {}
        self.begun = False
        self.envelopes: list[Envelope] = []
        self._metadata: dict[str, str] = {}
        self._attachments: dict[str, bytes] = {}
        self._blocks: list[bytes] = []

    def take(self, record: McapRecord) -> None:
        """Take the next record; TraceError if it is not one of a run."""
        self.begun = True
        match record:
            case Channel():
                self._channels[record.id] = record
            case Metadata() if record.name == METADATA:
                self._metadata.update(record.metadata)
            case Attachment():
                self._attachments[record.name.removesuffix(PACKED)] = _unpack(record)
            case Message():
                self._take_message(record)
            case _:
                pass

    def _take_message(self, message: Message) -> None:
        topic = self._channels[message.channel_id].topic
        if topic == EVENTS:
            self.envelopes.append(self._decoder.decode(message.data))
        elif topic == SIGNALS:
            self._blocks.append(message.data)

    def describe_damage(self) -> str:
        """Describe how far a damaged file could be read."""
        return f"is damaged after {len(self.envelopes)} events"

    def make(self, note: str) -> RecordedFile:
        """Return what was read."""
        about: dict[str, Any] = next((each.metadata for each in self._channels.values() if each.topic == SIGNALS), {})
        return RecordedFile(
            self._path,
            tuple(self.envelopes),
            self._metadata,
            self._attachments,
            note,
            tuple(self._blocks),
            about,
        )


def _unpack(attachment: Attachment) -> bytes:
    """Return what is in an attachment; ValueError if it is damaged or too large."""
    if not attachment.name.endswith(PACKED):
        return attachment.data
    unpacking = zlib.decompressobj(zlib.MAX_WBITS | 16)
    content = unpacking.decompress(attachment.data, MAX_RECORD_BYTES)
    if not unpacking.eof:
        raise ValueError(f"the attachment {attachment.name} is damaged")
    return content
