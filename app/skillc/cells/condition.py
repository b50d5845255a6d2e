"""The state of a cell beside those of its operations, and how a stop or a fault is acknowledged."""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from skillc.cells.database import DatabaseError
from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import JournalReader
from skillc.contract.cell import CellState
from skillc.errors import RequestError
from skillc_runtime.devices.backend import DeviceStop, StopPersists
from skillc_runtime.execution.cell_loop import CellLoop, NotDurable

STOP = "stop"
"""The name of the stop in the journal."""


class CellCondition:
    """Why a cell takes no operations: a fault, or a stop that a device has reported, until that is acknowledged.

    The stop is kept in the journal, so that it is still there when the cell is started again.
    """

    def __init__(self, name: str, loop: CellLoop, journal: CellJournal, reader: JournalReader) -> None:
        """Take over the stop that the last process of the cell left; DatabaseError if it cannot be read."""
        self._name, self._loop, self._journal = name, loop, journal
        saved = reader.state(STOP)
        try:
            self._stop = None if saved is None else msgspec.json.decode(saved, type=DeviceStop | None)
        except msgspec.MsgspecError as error:
            raise DatabaseError(f"{reader} has a stop that cannot be read ({error}): restore a backup") from error

    def describe(self) -> tuple[CellState, str]:
        """Return the state of the cell and why it is in it; the worst one, if it is in several."""
        stop, fault = self._stop, self._loop.fault or self._loop.backend.broken
        if stop is not None and (fault is None or stop.kind == "emergency-stop"):
            return stop.kind, stop.reason
        return ("operational", "") if fault is None else ("fault", fault)

    def require_operational(self) -> None:
        """Raise RequestError if the cell takes no operations."""
        state, reason = self.describe()
        if state != "operational":
            raise RequestError(f"{self._name} takes no operations ({state}): {reason}")

    def update(self) -> None:
        """Keep a stop that devices report, if it is news or worse, and let all operations fail because of it.

        The world model gets the states of devices while time passes, or here while nothing runs: never between the
        events of a run, which could not be repeated then.
        """
        if not self._loop.runs:
            self._loop.backend.publish()
        found, known = self._loop.backend.stops.report, self._stop
        if found is None or (known is not None and (known.kind == found.kind or known.kind == "emergency-stop")):
            return
        self._set(found)
        self._loop.abort(f"{found.kind.replace('-', ' ')}: {found.reason}")

    def acknowledge(self, commit: Callable[[], None]) -> None:
        """Take operations again; RequestError if there is nothing to acknowledge, or its cause is still there."""
        if (broken := self._loop.backend.broken) is not None:
            raise RequestError(f"{broken}; start the cell again")
        if self._loop.fault is None and self._stop is None:
            raise RequestError(f"{self._name} has no fault and no stop")
        stop = self._stop
        try:
            self._loop.backend.stops.clear()
            if stop is not None:
                self._set(None)
            commit()
        except (NotDurable, StopPersists) as error:
            if stop is not None:
                self._set(stop)
            raise RequestError(str(error)) from error
        self._loop.fault = None

    def _set(self, stop: DeviceStop | None) -> None:
        self._stop = stop
        self._journal.set_state(STOP, msgspec.json.encode(stop))
