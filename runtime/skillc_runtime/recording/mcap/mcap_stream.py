"""Events and samples as messages of an MCAP file."""

from __future__ import annotations

import time
from pathlib import Path
from typing import assert_never

import msgspec
from mcap.writer import Writer

from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.mcap.contents import (
    BLOCK_SCHEMA,
    ENVELOPE_SCHEMA,
    EVENTS,
    METADATA,
    PROFILE,
    SIGNALS,
    RunContents,
    encode_signals,
    make_block_schema,
    media_type,
)
from skillc_runtime.recording.mcap.signal_block import FORMAT, SignalBlock, encode_columns
from skillc_runtime.recording.mcap.signal_tap import SampledBlock, SampleLayout
from skillc_runtime.recording.signals.signal import Signal

CHUNK_BYTES = 1 << 20


class McapStream:
    """An MCAP file that is being written; OSError of all methods if that fails."""

    def __init__(
        self, path: Path, contents: RunContents, layout: SampleLayout | None, signals: tuple[Signal, ...]
    ) -> None:
        """Create the file with what the run is made of. With a `layout` it has `signals`."""
        self._file = path.open("wb")
        self._layout, self._units = layout, tuple(each.unit for each in signals)
        self._json, self._msgpack = msgspec.json.Encoder(), msgspec.msgpack.Encoder()
        try:
            self._writer = Writer(self._file, chunk_size=CHUNK_BYTES)
            self._begin(contents)
            schema = self._writer.register_schema(ENVELOPE_SCHEMA, "jsonschema", contents.envelope_schema)
            self._events = self._writer.register_channel(EVENTS, "json", schema)
            if layout is not None:
                schema = self._writer.register_schema(BLOCK_SCHEMA, "jsonschema", make_block_schema())
                about = {"format": str(FORMAT), "signals": encode_signals(signals)}
                self._signals = self._writer.register_channel(SIGNALS, "msgpack", schema, about)
            self._file.flush()
        except BaseException:
            self._file.close()
            raise

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

    def close(self) -> None:
        """Complete the file."""
        with self._file:
            self._writer.finish()  # type: ignore[no-untyped-call]

    def _begin(self, contents: RunContents) -> None:
        now = time.time_ns()
        self._writer.start(PROFILE)
        self._writer.add_metadata(METADATA, dict(contents.metadata))
        for name, content in contents.attachments.items():
            self._writer.add_attachment(now, now, name, media_type(name), content)

    def _add_block(self, block: SampledBlock) -> None:
        layout = self._layout
        assert layout is not None, "only a tap makes blocks"
        first_ns = round(block.first_s * 1e9)
        columns = encode_columns(layout.rows_of(block), self._units)
        content = self._msgpack.encode(SignalBlock(first_ns, layout.period_ns, block.rows, columns))
        self._writer.add_message(self._signals, first_ns, content, time.time_ns())
