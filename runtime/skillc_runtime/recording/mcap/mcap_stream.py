"""Events and samples as messages of an MCAP file."""

from __future__ import annotations

import gzip
import time
from typing import BinaryIO, TypeAlias, assert_never

import msgspec
from mcap.writer import Writer

from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.mcap.contents import (
    BLOCK_SCHEMA,
    ENVELOPE_SCHEMA,
    EVENTS,
    METADATA,
    PACKED,
    PROFILE,
    SIGNALS,
    RunContents,
    encode_signals,
    make_block_schema,
)
from skillc_runtime.recording.mcap.foxglove_types import make_foxglove_schema
from skillc_runtime.recording.mcap.sample_layout import SampledBlock
from skillc_runtime.recording.mcap.sample_messages import PICTURES, SampleMessages
from skillc_runtime.recording.mcap.signal_block import FORMAT
from skillc_runtime.recording.mcap.signal_tap import RecordedCell

CHUNK_BYTES = 1 << 20

Metadata: TypeAlias = dict[str, str]
"""Metadata of a run, by name, in addition to what it began with."""


class McapStream:
    """An MCAP file that is being written; OSError of all methods if that fails."""

    def __init__(self, file: BinaryIO, contents: RunContents, cell: RecordedCell | None) -> None:
        """Begin with what the run is made of. With a `cell` there will be samples of it."""
        self._json, self._msgpack = msgspec.json.Encoder(), msgspec.msgpack.Encoder()
        self._writer = Writer(file, chunk_size=CHUNK_BYTES)
        self._begin(contents)
        self._channels = {EVENTS: self._register(EVENTS, ENVELOPE_SCHEMA, contents.envelope_schema)}
        self._samples = None if cell is None else SampleMessages(cell)
        if cell is not None:
            about = {"format": str(FORMAT), "signals": encode_signals(cell.signals)}
            self._channels[SIGNALS] = self._register(SIGNALS, BLOCK_SCHEMA, make_block_schema(), "msgpack", about)
            for kind, topics in PICTURES.items():
                schema = self._writer.register_schema(
                    f"foxglove.{kind.__name__}", "jsonschema", make_foxglove_schema(kind)
                )
                for topic in topics:
                    self._channels[topic] = self._writer.register_channel(topic, "json", schema)
        file.flush()

    def add(self, item: Envelope | SampledBlock | Metadata) -> None:
        """Add an event, a block of samples, or metadata."""
        match item:
            case Envelope():
                content, moment = self._json.encode(item), round(item.cell_time_s * 1e9)
                self._writer.add_message(self._channels[EVENTS], moment, content, item.wall_time_ns, item.sequence)
            case SampledBlock():
                assert self._samples is not None, "only a tap makes blocks"
                for topic, first_ns, value in self._samples.make(item):
                    encode = self._msgpack.encode if topic == SIGNALS else self._json.encode
                    self._writer.add_message(self._channels[topic], first_ns, encode(value), time.time_ns())
            case dict():
                self._writer.add_metadata(METADATA, item)
            case _:
                assert_never(item)

    def flush(self) -> None:
        """Write what was added, so that it can be read whatever happens to this process."""
        self._writer.flush()  # type: ignore[no-untyped-call]

    def finish(self) -> None:
        """Write the end of the file, which stays open."""
        self._writer.finish()  # type: ignore[no-untyped-call]

    def _begin(self, contents: RunContents) -> None:
        now = time.time_ns()
        self._writer.start(PROFILE)
        self._writer.add_metadata(METADATA, dict(contents.metadata))
        for name, content in contents.attachments.items():
            packed = gzip.compress(content, mtime=0)
            self._writer.add_attachment(now, now, f"{name}{PACKED}", "application/gzip", packed)

    def _register(
        self, topic: str, name: str, schema: bytes, encoding: str = "json", about: dict[str, str] | None = None
    ) -> int:
        """Register a channel with a schema of its own; return its id."""
        number = self._writer.register_schema(name, "jsonschema", schema)
        return self._writer.register_channel(topic, encoding, number, about or {})
