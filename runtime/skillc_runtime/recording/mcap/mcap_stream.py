"""Events and samples as messages of an MCAP file."""

from __future__ import annotations

import gzip
import time
from typing import BinaryIO, assert_never

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
from skillc_runtime.recording.mcap.signal_block import FORMAT, SignalBlock, encode_columns
from skillc_runtime.recording.mcap.signal_tap import SampledBlock, SampleLayout
from skillc_runtime.recording.signals.signal import Signal

CHUNK_BYTES = 1 << 20


class McapStream:
    """An MCAP file that is being written; OSError of all methods if that fails."""

    def __init__(
        self, file: BinaryIO, contents: RunContents, layout: SampleLayout | None, signals: tuple[Signal, ...]
    ) -> None:
        """Begin with what the run is made of. With a `layout` there will be samples of `signals`."""
        self._layout, self._units = layout, tuple(each.unit for each in signals)
        self._json, self._msgpack = msgspec.json.Encoder(), msgspec.msgpack.Encoder()
        self._writer = Writer(file, chunk_size=CHUNK_BYTES)
        self._begin(contents)
        schema = self._writer.register_schema(ENVELOPE_SCHEMA, "jsonschema", contents.envelope_schema)
        self._events = self._writer.register_channel(EVENTS, "json", schema)
        if layout is not None:
            schema = self._writer.register_schema(BLOCK_SCHEMA, "jsonschema", make_block_schema())
            about = {"format": str(FORMAT), "signals": encode_signals(signals)}
            self._signals = self._writer.register_channel(SIGNALS, "msgpack", schema, about)
        file.flush()

    def add(self, item: Envelope | SampledBlock) -> None:
        """Add an event or a block of samples."""
        match item:
            case Envelope():
                content, moment = self._json.encode(item), round(item.cell_time_s * 1e9)
                self._writer.add_message(self._events, moment, content, item.wall_time_ns, item.sequence)
            case SampledBlock():
                self._add_block(item)
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

    def _add_block(self, block: SampledBlock) -> None:
        layout = self._layout
        assert layout is not None, "only a tap makes blocks"
        first_ns = round(block.first_s * 1e9)
        columns = encode_columns(layout.rows_of(block), self._units)
        content = self._msgpack.encode(SignalBlock(first_ns, layout.period_ns, block.rows, columns))
        self._writer.add_message(self._signals, first_ns, content, time.time_ns())
