"""What the devices of a simulated cell report of themselves, from which a twin of the cell is built."""

from __future__ import annotations

from collections.abc import Iterable

from msgspec import structs

from skillc_runtime.backends.simulation.checkpoint import decode_checkpoint, encode_checkpoint


def keep_reported(saved: bytes, prefixes: Iterable[str]) -> bytes:
    """Return a checkpoint with only what devices report: postures, openings, and what grippers count as held.

    `prefixes` are those of the names of all parts of arms and grippers. Where other things are, how a base really
    stands and what was wiped is left to the facts, and the clock starts at 0. CheckpointError if the checkpoint cannot
    be read.
    """
    checkpoint = decode_checkpoint(saved)
    held = {each.counted for each in checkpoint.grippers.values() if each.counted}
    reported = structs.replace(
        checkpoint,
        places={thing: place for thing, place in checkpoint.places.items() if thing in held},
        joints={name: values for name, values in checkpoint.joints.items() if name.startswith(tuple(prefixes))},
        bases={},
        worked={},
        clean={},
        time_s=0.0,
    )
    return encode_checkpoint(reported)
