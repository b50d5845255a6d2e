"""The reality of a simulated cell, which goes on where it was when the process of the cell ended."""

from __future__ import annotations

import time

from skillc.cells.database import DatabaseError
from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import JournalReader
from skillc.services.project.backends import BackendName, make_backend
from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.checkpoints import CheckpointError
from skillc_runtime.world.state.model import WorldModel

REALITY = "reality"
"""The name of the saved reality in the journal."""

PERIOD_S = 1.0
"""How much of what moves may be forgotten when the process dies, in s of wall time."""


def build_again(name: BackendName, world: WorldModel, seed: int, reader: JournalReader) -> Backend:
    """Return the cell as it was when it was last saved, or as its facts say if it never was.

    DatabaseError if what was saved cannot be read; errors as of `make_backend`.
    """
    saved = reader.state(REALITY)
    try:
        return make_backend(name, world, seed, saved)
    except CheckpointError as error:
        raise DatabaseError(f"{reader} has a simulation that cannot be read ({error}): restore a backup") from error


class RealityKeeper:
    """Saves the true state of a cell in its journal: with each write to the world, and from time to time.

    So a fact and what it says about become durable together: a gripper that is known to hold a part holds it. A real
    cell needs none of this: it is what it is.
    """

    def __init__(self, backend: Backend, journal: CellJournal) -> None:
        self._backend, self._journal = backend, journal
        self._checkpoints = backend.capabilities.checkpoints
        self._saved_at_s, self._due_s = -1.0, 0.0

    def has_changed(self) -> None:
        """Let the next commit save a state that has changed while no time has passed."""
        self._saved_at_s = -1.0

    def keep(self, *, standing: bool) -> None:
        """Add the present state to the next commit if it has to be saved; `standing` if no time passes any more."""
        now_s = self._backend.clock.now
        if self._checkpoints is None or self._backend.broken is not None:
            return
        moved = now_s != self._saved_at_s and (standing or time.monotonic() >= self._due_s)
        if moved or self._journal.has_writes:
            self._saved_at_s, self._due_s = now_s, time.monotonic() + PERIOD_S
            self._journal.set_state(REALITY, self._checkpoints.save())
