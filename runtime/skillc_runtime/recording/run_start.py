"""What a run of a cell began from, so that it can be repeated: the world, the evidence for it, and the true state."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import msgspec
import pyoxigraph as ox

from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.store.change_json import decode_changes, encode_changes
from skillc_runtime.store.triples import all_triples, declarations
from skillc_runtime.store.world_from_triples import build_world
from skillc_runtime.world.state.consistency.hidden_truth import hide
from skillc_runtime.world.state.evidence import LedgerWrite, UndoableWrite
from skillc_runtime.world.state.facts import Evidence
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState


class StartError(ValueError):
    """The start of a run cannot be read."""


class RecordedWrite(msgspec.Struct, frozen=True, array_like=True):
    """A write to the world before the run, with the changes that lead back, both as JSON."""

    evidence: Evidence | None
    origin: str
    changes: str
    undo: str


class RunStart(msgspec.Struct, frozen=True, kw_only=True):
    """The start of a run: the facts as N-Triples, the writes that led to them, and the true state of the cell.

    `simulation` is the checkpoint from which the cell was built for the run, `ticks` the number of its first tick,
    `hidden` what was true but not known, as JSON.
    """

    facts: str
    writes: tuple[RecordedWrite, ...]
    ticks: int
    simulation: bytes
    hidden: str = ""


def encode_start(
    state: WorldState, library: Vocabulary, writes: tuple[LedgerWrite, ...], ticks: int, simulation: bytes
) -> bytes:
    """Return the start of a run as MessagePack; `library` is the vocabulary of its library.

    StoreError for a fact that a triple cannot state.
    """
    triples = {*declarations(library, state.vocabulary), *all_triples(state)}
    facts = "".join(f"{each} .\n" for each in sorted(map(str, triples)))
    start = RunStart(
        facts=facts,
        writes=tuple(_record(each.undoable) for each in writes),
        ticks=ticks,
        simulation=simulation,
        hidden=encode_changes(state.hidden.facts) if state.hidden.facts else "",
    )
    return msgspec.msgpack.encode(start)


def decode_start(encoded: bytes) -> RunStart:
    """Read what `encode_start` returned; StartError if it cannot be read."""
    try:
        return msgspec.msgpack.decode(encoded, type=RunStart)
    except msgspec.MsgspecError as error:
        raise StartError(str(error)) from error


def build_world_again(start: RunStart, library: Vocabulary) -> WorldModel:
    """Return the world of a run at its start, with the evidence. StartError or StoreError if it cannot be read."""
    try:
        state = build_world(_parse(start.facts), library, "the world at the start of the run")
        world = WorldModel(
            replace(state, hidden=hide(decode_changes(start.hidden), state.vocabulary)) if start.hidden else state
        )
        world.ledger.restore(world.snapshot(), tuple(map(_read, start.writes)))
    except (ValueError, SyntaxError) as error:
        raise StartError(str(error)) from error
    return world


def _record(write: UndoableWrite) -> RecordedWrite:
    return RecordedWrite(write.evidence, write.origin, encode_changes(write.changes), encode_changes(write.undo))


def _read(write: RecordedWrite) -> UndoableWrite:
    return UndoableWrite(write.evidence, write.origin, decode_changes(write.changes), decode_changes(write.undo))


def _parse(facts: str) -> Iterator[ox.Triple]:
    for quad in ox.parse(facts, format=ox.RdfFormat.N_TRIPLES):
        yield quad.triple
