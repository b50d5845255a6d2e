"""Resets a simulated cell to its scene, saves it and restores it: its world and its reality together."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import assert_never

import msgspec
from msgspec import structs

from skillc.cells.cell_backend import CellBackend
from skillc.cells.evidence import EvidenceKeeper, StoredWrite, read_write, store_write
from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import JournalReader, find_checkpoint
from skillc.cells.settings import CellSettings
from skillc.contract.cell import CellCheckpoint
from skillc.contract.messages import CheckpointCommand, Forget, Reset, Restore, Save
from skillc.errors import RequestError, ServiceError
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.scene.stores import identify_scene, load_world
from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.checkpoints import CheckpointError, Checkpoints
from skillc_runtime.store.change_json import decode_changes, encode_changes
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.difference import changes_between
from skillc_runtime.world.state.evidence import UndoableWrite
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.world_state import WorldState

MAX_CHECKPOINTS = 100
"""The most checkpoints of a cell."""


class SavedCell(msgspec.Struct, frozen=True):
    """The content of a checkpoint: the changes from an empty world, the writes that led there, the state of reality."""

    world: str
    writes: tuple[StoredWrite, ...]
    reality: bytes


class CellCheckpoints:
    """The checkpoints of a cell. No operation may go on in it while one is saved or restored."""

    def __init__(
        self, settings: CellSettings, scene: Path, devices: CellBackend, evidence: EvidenceKeeper, journal: CellJournal,
        reader: JournalReader,
    ) -> None:  # fmt: skip
        self._settings, self._scene, self._devices = settings, scene, devices
        self._evidence, self._journal, self._reader = evidence, journal, reader

    @property
    def possible(self) -> bool:
        """Whether the cell can be reset, saved and restored."""
        return self._devices.backend.capabilities.checkpoints is not None

    def carry_out(self, wanted: CheckpointCommand, world: WorldModel, library: SkillLibrary) -> None:
        """Do what a client wants, in the next commit of the journal; RequestError if it is refused."""
        match wanted:
            case Reset(who=who, why=why):
                self._require()
                state = load_world(self._scene, world.snapshot().vocabulary, SilentReporter())
                self._become(world, state, (), None, _describe(who, "reset to the scene", why))
            case Save(name=name, who=who):
                self._save(name, who, world, library)
            case Restore(name=name, who=who, why=why):
                self._restore(name, world, library, _describe(who, f"restored {name}", why))
            case Forget(name=name):
                find_checkpoint(name, self._reader.checkpoints(), self._settings.name)
                self._journal.remove_checkpoint(name)
            case _:
                assert_never(wanted)

    def _require(self) -> Checkpoints:
        found = self._devices.backend.capabilities.checkpoints
        if found is None:
            raise RequestError(f"{self._settings.name} is no simulation: what is in it is not made again by a command")
        return found

    def _save(self, name: str, who: str, world: WorldModel, library: SkillLibrary) -> None:
        checkpoints, known = self._require(), self._reader.checkpoints()
        if any(each.name == name for each in known):
            raise RequestError(f"there is a checkpoint {name} already; remove it first, or take another name")
        if len(known) >= MAX_CHECKPOINTS:
            raise RequestError(f"{self._settings.name} has {MAX_CHECKPOINTS} checkpoints; remove some")
        if (broken := self._devices.backend.broken) is not None:
            raise RequestError(f"there is nothing to save: {broken}")
        state = world.snapshot()
        facts = encode_changes(changes_between(WorldState.empty(state.vocabulary), state))
        writes = tuple(map(store_write, world.ledger.list_undoable()))
        content = msgspec.msgpack.encode(SavedCell(facts, writes, checkpoints.save()))
        self._journal.add_checkpoint(self._describe(name, who, library), content)

    def _restore(self, name: str, world: WorldModel, library: SkillLibrary, origin: str) -> None:
        self._require()
        found = find_checkpoint(name, self._reader.checkpoints(), self._settings.name)
        self._require_same(found, self._describe(name, "", library))
        empty = WorldState.empty(world.snapshot().vocabulary)
        try:
            saved = msgspec.msgpack.decode(self._reader.checkpoint_content(name), type=SavedCell)
            state = empty.with_changes(decode_changes(saved.world))
            writes = tuple(map(read_write, saved.writes))
        except (msgspec.MsgspecError, ValueError) as error:
            raise RequestError(f"the checkpoint {name} cannot be read: {error}") from error
        self._become(world, state, writes, saved.reality, origin)

    def _become(
        self, world: WorldModel, state: WorldState, writes: Sequence[UndoableWrite], saved: bytes | None, origin: str
    ) -> None:
        """Replace the world by a version of it, its evidence by that of `writes`, and reality by what was `saved`.

        Without `saved`, reality is built from the facts. Nothing changes if the cell cannot be built.
        """
        try:
            self._devices.try_out(state, saved)
            world.commit(changes_between(world.snapshot(), state), origin, None)
        except (SheetError, FrameError, WorldError, CheckpointError) as error:
            raise RequestError(f"{self._settings.name} cannot be made again: {error}") from error
        self._evidence.replace(writes, origin)
        self._devices.build(saved)
        self._give_up()

    def _give_up(self) -> None:
        """Give up the operations that were interrupted: the cell is not as they left it."""
        for each in self._reader.continuable():
            assert each.ended is not None, "it was interrupted"
            self._journal.end_operation(structs.replace(each.ended, decisions=()))

    def _require_same(self, saved: CellCheckpoint, now: CellCheckpoint) -> None:
        """Raise RequestError if a checkpoint was saved with another scene, library, back end or seed."""
        for what in ("scene", "library_hash", "backend", "seed"):
            one, other = getattr(saved, what), getattr(now, what)
            if one != other:
                word = what.removesuffix("_hash")
                raise RequestError(
                    f"{saved.name} was saved with another {word} ({one}) than the cell has now ({other}); "
                    "reset the cell and save it again"
                )

    def _describe(self, name: str, who: str, library: SkillLibrary) -> CellCheckpoint:
        settings = self._settings
        try:
            scene = identify_scene(self._scene).removeprefix("scene ")
        except OSError as error:
            raise ServiceError(f"the scene {self._scene} cannot be read: {error.strerror}") from error
        return CellCheckpoint(
            name=name,
            who=who,
            saved_ns=time.time_ns(),
            scene=scene,
            library_hash=library.hash,
            backend=settings.backend,
            seed=settings.seed,
        )


def _describe(who: str, what: str, why: str) -> str:
    return f"{who}: {what}, {why}" if why else f"{who}: {what}"
