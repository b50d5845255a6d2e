"""The pace of a cell: how fast its time may pass, which outlives its process."""

from __future__ import annotations

from skillc.cells.cell_backend import CellBackend
from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import JournalReader
from skillc.services.project.backends import check_pace
from skillc_runtime.execution.pace import FAST, REAL, Pace, format_pace, parse_pace

PACE = "pace"
"""The name under which the journal has what was set last."""


class CellPace(Pace):
    """The pace of a cell, at first that which was set last; devices with a time of their own have only that."""

    def __init__(self, devices: CellBackend, journal: CellJournal, reader: JournalReader) -> None:
        self._devices, self._journal = devices, journal
        kept = reader.state(PACE)
        factor = FAST if kept is None else parse_pace(kept.decode())
        super().__init__(factor if self.can_change else REAL)

    @property
    def can_change(self) -> bool:
        """Whether it can be set."""
        return self._devices.backend.capabilities.lock_step is not None

    @property
    def limit(self) -> float | None:
        """The factor that limits ticks; None if nothing does."""
        return None if self.factor == FAST else self.factor

    def set(self, factor: float) -> None:
        """Change the factor, here and in the journal; RequestError for one that the cell cannot have."""
        check_pace(self._devices.backend, factor)
        if self.can_change:
            self.change(factor)
            self._journal.set_state(PACE, format_pace(factor).encode())
