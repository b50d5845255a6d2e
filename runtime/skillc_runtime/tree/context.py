"""What all nodes of one run share: the time and world state of this tick, the cell, the library, the listener."""

from __future__ import annotations

from collections.abc import Sequence

from skillc_compiler.library.skills import SkillLibrary
from skillc_compiler.library.vocabulary import Position
from skillc_runtime.robots.cell import Cell
from skillc_runtime.trace.events import Listener, Note
from skillc_runtime.tree.locks import Locks
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.world_state import WorldState


class Context:
    """The run's one mutable place beside its nodes.

    `state` is the snapshot this tick reads; `now` is the run's own time in seconds, which stands still while paused;
    `time` is the cell's clock. `emit` is None when nobody listens, and then no event is built.
    """

    __slots__ = ("_snapshot", "cell", "emit", "last_id", "library", "locks", "now", "paused_s", "state", "time")

    def __init__(self, library: SkillLibrary, cell: Cell, emit: Listener | None, locks: Locks, ids: int = 0) -> None:
        self.library = library
        self.cell = cell
        self.emit = emit
        self.locks = locks
        self.paused_s = 0.0
        self.time = self.now = 0.0
        self.state: WorldState
        self.last_id = ids
        self._snapshot = cell.world.snapshot
        self.begin_tick()

    def next_id(self) -> int:
        """Return a number no other node of the run has."""
        self.last_id += 1
        return self.last_id

    def begin_tick(self) -> None:
        """Take the time and the newest snapshot."""
        self.time = now = self.cell.now
        self.now = now - self.paused_s
        self.state = self._snapshot()

    def refresh(self) -> None:
        """Take the newest snapshot, after somebody wrote."""
        self.state = self._snapshot()

    def assume(self, changes: Sequence[Change], origin: str) -> None:
        """Write what nothing measured in one transaction and read on from the result; WorldError refuses it all."""
        self.cell.world.commit(changes, origin, "assumed")
        self.refresh()

    def note(self, message: str, node: int = 0, source: Position | None = None) -> None:
        """Tell the listener something that decides nothing."""
        if self.emit is not None:
            self.emit(Note(time=self.time, message=message, node=node, source=source))
