"""Events and samples as messages of an MCAP file."""

from __future__ import annotations

import gzip
import time
from collections.abc import Iterator, Mapping
from typing import BinaryIO, TypeAlias, assert_never

import msgspec
import numpy as np
from mcap.writer import Writer

from skillc_rdf.vocabulary.types import local_name
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
from skillc_runtime.recording.mcap.foxglove import FIXED, FORCES, MOVING, SCENE, ScenePicture, describe_forces
from skillc_runtime.recording.mcap.foxglove_types import FrameTransforms, SceneUpdate, make_foxglove_schema
from skillc_runtime.recording.mcap.sample_layout import SampledBlock
from skillc_runtime.recording.mcap.signal_block import FORMAT, SignalBlock, encode_columns
from skillc_runtime.recording.mcap.signal_tap import RecordedCell

PICTURES: Mapping[type[msgspec.Struct], tuple[str, ...]] = {
    FrameTransforms: (FIXED, MOVING),
    SceneUpdate: (SCENE, FORCES),
}
"""The topics of pictures, by the type of their messages."""

Message = tuple[str, int, msgspec.Struct]
"""A topic, the time of the cell in ns, and what is said."""


class SampleMessages:
    """Makes the messages of blocks of samples, one after the other."""

    def __init__(self, cell: RecordedCell) -> None:
        self._layout = cell.tap.layout
        self._picture = None if cell.model is None else ScenePicture(cell.model)
        self._units = tuple(each.unit for each in cell.signals)
        self._is_shown = False

    def make(self, block: SampledBlock) -> Iterator[Message]:
        """Yield the messages of the next block."""
        first_ns = round(block.first_s * 1e9)
        columns = encode_columns(self._layout.rows_of(block), self._units)
        yield SIGNALS, first_ns, SignalBlock(first_ns, self._layout.period_ns, block.rows, columns)
        faces = tuple(self._layout.faces_of(block))
        if self._picture is None:
            return
        if not block.poses:
            return
        times_s, *places = zip(*block.poses, strict=True)
        positions, quaternions = (np.frombuffer(b"".join(each)) for each in places)
        count = len(times_s)
        where = positions.reshape(count, -1, 3), quaternions.reshape(count, -1, 4)
        if not self._is_shown:
            self._is_shown, moment = True, round(times_s[0] * 1e9)
            yield SCENE, moment, self._picture.shapes(times_s[0])
            yield FIXED, moment, self._picture.fixed_frames(times_s[0], where[0][0], where[1][0])
        for time_s, frames in zip(times_s, self._picture.moving_frames(times_s, *where), strict=True):
            moment = round(time_s * 1e9)
            yield MOVING, moment, frames
            row = min((moment - first_ns) // self._layout.period_ns, block.rows - 1)
            yield FORCES, moment, describe_forces(time_s, [(local_name(tool), face[row]) for tool, face in faces])


CHUNK_BYTES = 1 << 20
QUICK = 3
"""The level at which attachments are compressed: a library takes an eighth of the time of the highest one."""

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
            packed = gzip.compress(content, QUICK, mtime=0)
            self._writer.add_attachment(now, now, f"{name}{PACKED}", "application/gzip", packed)

    def _register(
        self, topic: str, name: str, schema: bytes, encoding: str = "json", about: dict[str, str] | None = None
    ) -> int:
        """Register a channel with a schema of its own; return its id."""
        number = self._writer.register_schema(name, "jsonschema", schema)
        return self._writer.register_channel(topic, encoding, number, about or {})
