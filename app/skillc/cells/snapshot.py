"""What a cell knows at one instant, for processes that answer questions about it: its library and its world."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any, cast

from skillc.cells.library import decode_library, encode_library
from skillc.services.project.backends import BackendName
from skillc.services.project.project import DEFAULT_BACKEND
from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.cell import Cell
from skillc_runtime.devices.checkpoints import Checkpoints
from skillc_runtime.execution.refinement.run_planning import Postures, measure_postures
from skillc_runtime.world.state.evidence import EvidenceLedger, UndoableWrite
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True)
class CellSnapshot:
    """The library of a cell, a version of its world, the writes that led to it, and the number of the last one.

    `devices` is what the devices report of themselves, as a checkpoint of the backend; empty if it is not asked for.
    `postures` are those of the arms, (nv,) in rad by IRI, None if they are not asked for.
    """

    library: SkillLibrary
    state: WorldState
    writes: tuple[UndoableWrite, ...]
    sequence: int
    backend: BackendName = "mujoco"
    devices: bytes = b""
    postures: Postures | None = None

    @cached_property
    def ledger(self) -> EvidenceLedger:
        """The evidence for the facts, made of the writes where it is needed: their versions take long to send."""
        ledger = EvidenceLedger()
        ledger.restore(self.state, self.writes)
        return ledger

    def __reduce__(self) -> tuple[Callable[..., CellSnapshot], tuple[Any, ...]]:
        """Pickle the library in the format in which cells get it: that is thirty times as fast as its objects."""
        others = (self.state, self.writes, self.sequence, self.backend, self.devices, self.postures)
        return _restore, (encode_library(self.library), *others)


class SnapshotTaker:
    """Takes encoded snapshots of a cell."""

    def __init__(self, world: WorldModel, backend: BackendName) -> None:
        self._world, self._backend = world, backend
        self._last: tuple[int, SkillLibrary, bytes] | None = None

    def take(self, library: SkillLibrary) -> bytes:
        """Return what the cell knows now; the same bytes again while neither the world nor the library changes."""
        sequence = self._world.sequence
        if self._last is None or self._last[0] != sequence or self._last[1] is not library:
            self._last = sequence, library, encode_snapshot(self._describe(library))
        return self._last[2]

    def take_with_arms(self, library: SkillLibrary, cell: Cell) -> bytes:
        """Return what the cell knows now, and where its arms are."""
        return encode_snapshot(replace(self._describe(library), postures=measure_postures(cell)))

    def take_twin(self, library: SkillLibrary, checkpoints: Checkpoints | None) -> bytes:
        """Return what the cell knows now and what its devices report: a twin of it is built from that.

        The twin of a cell without `checkpoints` is simulated from what is known.
        """
        known = self._describe(library)
        if checkpoints is None:
            return encode_snapshot(replace(known, backend=DEFAULT_BACKEND))
        return encode_snapshot(replace(known, devices=checkpoints.save_reported()))

    def _describe(self, library: SkillLibrary) -> CellSnapshot:
        world = self._world
        return CellSnapshot(library, world.snapshot(), world.ledger.list_undoable(), world.sequence, self._backend)


def _restore(library: bytes, *others: Any) -> CellSnapshot:
    return CellSnapshot(_decode(library), *others)


@lru_cache(maxsize=2)
def _decode(library: bytes) -> SkillLibrary:
    """Return a library; a worker reads each once, since a large one takes longer than most answers."""
    return decode_library(library)


def encode_snapshot(snapshot: CellSnapshot) -> bytes:
    """Return a snapshot for another process of this program."""
    return pickle.dumps(snapshot, pickle.HIGHEST_PROTOCOL)


def decode_snapshot(encoded: bytes) -> CellSnapshot:
    """Read what a cell has encoded; nothing else may be read with this, since a pickle can contain code."""
    return cast(CellSnapshot, pickle.loads(encoded))
