"""The recordings of the operations of a cell: an MCAP file for each, written while it goes on."""

from __future__ import annotations

import time
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from skillc.cells.operations.recording_files import recording_file
from skillc.cells.operations.submitted import SubmittedOperation
from skillc.contract.operation import OperationRequest
from skillc.services.reporting.reporter import Reporter
from skillc.services.run.recordings import KnownStart, describe_contents
from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.attempt import CellOrigin
from skillc_runtime.recording.envelope import Recorder
from skillc_runtime.recording.events import Note
from skillc_runtime.recording.mcap.contents import CLOSE_S, NOT_REPEATABLE
from skillc_runtime.recording.mcap.recording_file import RecordingFile
from skillc_runtime.recording.states import State
from skillc_runtime.scene.load import load_sheets

if TYPE_CHECKING:
    from skillc.cells.cell_backend import Beginning, CellBackend

MOVING: frozenset[State] = frozenset({"running", "pausing", "paused", "stopping"})
"""The states of an operation in which its signals are recorded: before, nothing moves because of it."""


class CellRecordings:
    """Records the operations of a cell. The loop never waits; what cannot be written is reported, not raised."""

    def __init__(self, folder: Path, devices: CellBackend, origin: CellOrigin, reporter: Reporter) -> None:
        """`folder` is that of the cell."""
        self._folder, self._devices, self._origin, self._reporter = folder, devices, origin, reporter
        self._sheets = load_sheets(devices.backend.cell.world.snapshot().vocabulary)
        self._going: dict[str, RecordingFile] = {}
        self._ending: list[RecordingFile] = []

    def begin(
        self, operation: str, request: OperationRequest, library: SkillLibrary, beginning: Beginning, ticks: int
    ) -> tuple[Recorder, ...]:
        """Begin a recording and return who gets the events; nobody if that is not possible.

        The operation begins as `beginning` says, with the tick of that number.
        """
        world = self._devices.backend.cell.world
        start = KnownStart(world.snapshot(), world.ledger.writes, ticks, beginning.checkpoint, beginning.obstacle)
        task = request.task or request.goal or request.call or ""
        describe = partial(describe_contents, operation, task, library, start, self._origin, request, self._sheets)
        path = recording_file(self._folder, operation)
        try:
            path.parent.mkdir(exist_ok=True)
            self._going[operation] = RecordingFile(path, describe, self._devices.recorded)
        except OSError as error:
            self._reporter.say(f"warning: {path} cannot be written: {error.strerror or error}")
            return ()
        return (self._going[operation],)

    def note_company(self, operation: str) -> None:
        """Note in the recordings of all others that this operation goes on in the same cell."""
        for recording in self._going.values():
            recording.add_metadata({NOT_REPEATABLE: f"the operation {operation} went on in the same cell"})

    def update(self, submitted: SubmittedOperation) -> None:
        """Record signals as the state of an operation wants it; note in it that its recording has ended early."""
        operation = submitted.run.id
        recording = self._going.get(operation)
        if recording is None:
            return
        if recording.problem is not None and not submitted.run.ended:
            self.end(operation)
            submitted.publisher(Note(time=self._devices.backend.clock.now, message=f"warning: {recording.problem}"))
        else:
            recording.sample(submitted.run.state in MOVING)

    def end(self, operation: str) -> None:
        """End a recording; its file is completed in another thread."""
        recording = self._going.pop(operation, None)
        if recording is not None:
            recording.end()
            self._ending.append(recording)
        self._report()

    def close(self) -> None:
        """End all recordings and wait until they are complete, together as long as one may take."""
        for operation in tuple(self._going):
            self.end(operation)
        end = time.monotonic() + CLOSE_S
        for each in self._ending:
            each.close(max(0.0, end - time.monotonic()))
        self._report()

    def _report(self) -> None:
        """Report those that could not be written completely, once they are at their end."""
        for each in self._ending:
            if each.is_complete and each.problem is not None:
                self._reporter.say(f"warning: {each.problem}")
        self._ending = [each for each in self._ending if not each.is_complete]
