"""What is in the MCAP file of a run: its channels, its metadata and its attachments."""

from __future__ import annotations

import json
from collections.abc import Mapping

import msgspec

from skillc_runtime.recording.mcap.signal_block import SignalBlock
from skillc_runtime.recording.signals.signal import Signal

CLOSE_S = 20.0
"""How long the end of a recording may take, in s of wall time."""

PROFILE = "skillc"
EVENTS, SIGNALS = "/events", "/signals"
"""The topics of the channels."""

METADATA = "skillc"
"""The name of the metadata record of a run."""

ENVELOPE_SCHEMA, BLOCK_SCHEMA = "skillc.Envelope", "skillc.SignalBlock"

NOT_REPEATABLE = "not_repeatable"
"""What says in the metadata why a run cannot be repeated; it may come after the events."""

LIBRARY, SCENE, SETTINGS, START = "library.json", "scene.ttl", "settings.json", "start.msgpack"
"""The attachments; `START` is in the recordings of cells that go on from run to run."""

PACKED = ".gz"
"""What the names of attachments end with in the file: they are compressed with gzip."""


class RunContents(msgspec.Struct, frozen=True):
    """What a run was made of: `metadata` is text by name, `attachments` are files by name.

    `envelope_schema` is the JSON Schema of an event.
    """

    metadata: Mapping[str, str]
    attachments: Mapping[str, bytes] = msgspec.field(default_factory=dict)
    envelope_schema: bytes = b"{}"


def make_block_schema() -> bytes:
    """Return the JSON Schema of a block of signals, which is stored as MessagePack."""
    (_,), components = msgspec.json.schema_components((SignalBlock,), ref_template="#/$defs/{name}")
    return json.dumps({**components["SignalBlock"], "$defs": components}).encode()


def encode_signals(signals: tuple[Signal, ...]) -> str:
    """Return signals as the text in the metadata of their channel."""
    return msgspec.json.encode(signals).decode()


def decode_signals(text: str) -> tuple[Signal, ...]:
    """Return the signals in the metadata of a channel; msgspec.DecodeError if there are none."""
    return msgspec.json.decode(text, type=tuple[Signal, ...])
