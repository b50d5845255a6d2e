"""The back end of a cell, and who reads it: an operation that has it alone begins where it can be begun again."""

from __future__ import annotations

import time
from collections.abc import Collection
from dataclasses import dataclass

from skillc.cells.database import DatabaseError
from skillc.cells.geometry_reader import GeometryReader
from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import JournalReader
from skillc.cells.samples import Sampler
from skillc.cells.settings import CellSettings
from skillc.services.project.backends import BackendName, make_backend
from skillc.services.run.recordings import find_obstacle, make_recorded_cell
from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.checkpoints import CheckpointError
from skillc_runtime.primitives.standing_bases import place_standing_bases
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState

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


@dataclass(frozen=True, slots=True)
class Beginning:
    """The checkpoint from which a cell was built when an operation began; `obstacle` is why there is none."""

    checkpoint: bytes = b""
    obstacle: str = ""


class CellBackend:
    """The back end of a cell. `backend`, and who reads it, are others after `begin` where it can be built again."""

    def __init__(self, settings: CellSettings, world: WorldModel, journal: CellJournal, reader: JournalReader) -> None:
        """Build it as it was when the cell ended; errors of `build_again`."""
        self._settings, self._world, self._journal = settings, world, journal
        self._use(build_again(settings.backend, world, settings.seed, reader))

    def begin(self, others: Collection[str]) -> Beginning:
        """Build a simulation again from its true state, as whoever repeats the operation that begins now.

        Motors, controllers and noise carry nothing over then that a checkpoint does not have. That is not possible
        while `others` go on.
        """
        if others:
            return Beginning(obstacle=f"the operation {min(others)} went on in the cell when it began")
        capabilities = self.backend.capabilities
        if capabilities.checkpoints is None:
            return Beginning(obstacle=find_obstacle(self.backend) or "its cell cannot be built again as it was")
        if capabilities.disturber is not None and capabilities.disturber.acts:
            return Beginning(obstacle="the cell was being disturbed when it began")
        checkpoint = capabilities.checkpoints.save()
        try:
            backend = make_backend(self._settings.backend, self._world, self._settings.seed, checkpoint)
        except (SheetError, FrameError) as error:
            return Beginning(obstacle=f"its cell cannot be built from the facts that were known when it began: {error}")
        self.backend.close()
        self._use(backend)
        return Beginning(checkpoint)

    def try_out(self, state: WorldState, saved: bytes | None) -> None:
        """Raise what `build` would raise with this version of the world."""
        make_backend(self._settings.backend, WorldModel(state), self._settings.seed, saved).close()

    def build(self, saved: bytes | None) -> None:
        """Build the cell again as it was saved, or as its facts say; errors as of `make_backend`."""
        backend = make_backend(self._settings.backend, self._world, self._settings.seed, saved)
        self.backend.close()
        self._use(backend)

    def _use(self, backend: Backend) -> None:
        self.backend = backend
        self.keeper = RealityKeeper(backend, self._journal)
        self.sampler, self.geometry = Sampler(self._settings.name, backend), GeometryReader(backend)
        self.recorded = make_recorded_cell(backend)
        place_standing_bases(backend.cell)
