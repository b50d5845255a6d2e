"""A cell that runs: its loop, its world and its journal, for whoever ticks it and gives it operations."""

from __future__ import annotations

import time
from collections.abc import Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path

from msgspec import structs

from skillc.cells.cell_backend import CellBackend
from skillc.cells.checkpoints import CellCheckpoints
from skillc.cells.condition import CellCondition
from skillc.cells.database import DatabaseError
from skillc.cells.disturbing import disturb_cell
from skillc.cells.editing import edit_world
from skillc.cells.evidence import EvidenceKeeper
from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import JournalReader
from skillc.cells.library import decode_library
from skillc.cells.operations.assigning import assign_request
from skillc.cells.operations.continuing import decisions_about, find_interrupted, prepare_continuation, take_over
from skillc.cells.operations.recordings import CellRecordings
from skillc.cells.operations.submitted import SubmittedOperation
from skillc.cells.pace import CellPace
from skillc.cells.settings import CellSettings
from skillc.cells.snapshot import SnapshotTaker
from skillc.contract.cell import CellStatus
from skillc.contract.messages import CheckpointCommand, Edit, Place, Reset, Restore
from skillc.contract.operation import OperationRequest, OperationStatus
from skillc.errors import RequestError
from skillc.services.reporting.reporter import Reporter
from skillc.services.space.run_looks import look_from
from skillc.services.tasks.breakpoints import make_gate, parse_breakpoints
from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.disturbances import Disturbance
from skillc_runtime.execution import task_planning  # noqa: F401  those that plan are forks, which share it
from skillc_runtime.execution.assignment import Assignment
from skillc_runtime.execution.attempt import CellOrigin
from skillc_runtime.execution.cell_loop import CellLoop, NotDurable, Request, TooManyRequests
from skillc_runtime.execution.continuation import Continuation
from skillc_runtime.execution.planning_job import PlanningJob
from skillc_runtime.execution.planning_queue import PlanningQueue
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.preparation import prepare_after
from skillc_runtime.execution.tree.gate import format_breakpoints
from skillc_runtime.execution.world_edit import recorded_changes
from skillc_runtime.recording.commands import Command, SetBreakpoints
from skillc_runtime.recording.events import Disturbed
from skillc_runtime.recording.history.account import RunAccount
from skillc_runtime.recording.publisher import Publisher
from skillc_runtime.recording.run_spec import specify
from skillc_runtime.recording.states import ENDS
from skillc_runtime.world.state.model import WorldModel

MAX_OPERATIONS = 200
"""How many operations may go on or wait in a cell; those beyond are refused."""


class CellHost:
    """Carries out operations in a cell. `tick` is called again and again; nothing else lets time pass.

    The cell is the only one that writes to its world and its journal. What is submitted or requested takes effect in
    the next tick, and is durable when that ends.
    """

    def __init__(
        self,
        settings: CellSettings,
        library: SkillLibrary,
        world: WorldModel,
        journal: CellJournal,
        reader: JournalReader,
        scene: Path,
        reporter: Reporter,
    ) -> None:
        """Build the cell; SheetError or FrameError if its scene cannot be simulated, DatabaseError of `build_again`."""
        self.settings, self.library = settings, library
        self.world, self._journal, self._reader = world, journal, reader
        self.devices = CellBackend(settings, world, journal, reader)
        self.pace = CellPace(self.devices, journal, reader)
        self._evidence = EvidenceKeeper(world, journal, reader)
        self._checkpoints = CellCheckpoints(settings, scene, self.devices, self._evidence, journal, reader)
        self._resets = 0
        self._plans = PlanningQueue(self._plan)
        origin = CellOrigin(str(scene), settings.seed, settings.backend)
        self._recordings = CellRecordings(Path(settings.folder), self.devices, origin, reporter)
        self.loop = CellLoop(self.devices.backend, library, self._plans, origin, commit=self._commit)
        self._condition = CellCondition(settings.name, self.loop, journal, reader)
        self._operations: dict[str, SubmittedOperation] = {}
        self._snapshots = SnapshotTaker(world, settings.backend)

    def describe(self) -> CellStatus:
        """Return the cell as it is now."""
        (state, reason), settings = self._condition.describe(), self.settings
        return CellStatus(
            name=settings.name,
            scene=settings.scene,
            library=self.library.name,
            library_hash=self.library.hash,
            backend=settings.backend,
            state=state,
            reason=reason,
            pace=self.pace.limit,
            paceable=self.pace.can_change,
            resettable=self._checkpoints.possible,
            resets=self._resets,
        )

    def acknowledge(self) -> None:
        """Take operations again after a fault or a stop whose cause is removed.

        RequestError if there is none, or it persists.
        """
        self._condition.acknowledge(self._commit)

    def submit(self, operation: str, request: OperationRequest, assignment: Assignment | None = None) -> None:
        """Take an operation, with an id that no other has. RequestError or DiagnosticsError if it cannot be one.

        `assignment` is what it asks for, if that was read before. TooManyRequests if as many as possible go on.
        """
        if operation in self._operations or self._journal.has_operation(operation):
            raise RequestError(f"there is already an operation {operation}")
        self._condition.require_operational()
        if len(self._operations) >= MAX_OPERATIONS:
            raise TooManyRequests(f"{MAX_OPERATIONS} operations go on or wait in {self.settings.name}; try again later")
        if request.continues:
            self._continue(operation, request)
        else:
            self._submit(operation, request, Continuation(assignment or self._assign(request)))

    def request(self, operation: str, command: Command) -> Request:
        """Give a command to an operation in the next tick; RequestError if it has ended, or for a wrong breakpoint."""
        if operation not in self._operations:
            raise RequestError(f"no operation {operation} goes on in {self.settings.name}")
        if isinstance(command, SetBreakpoints):
            found = parse_breakpoints(command.breakpoints, self.library)
            command = SetBreakpoints(format_breakpoints(found))
        return self.loop.request(self._operations[operation].run, command)

    def reorder(self, first: Sequence[str]) -> None:
        """Let operations come before all others that wait, in this order; RequestError if one does not wait."""
        waiting = {each.id: each for each in self.loop.runs if each.waits}
        if missing := [each for each in first if each not in waiting]:
            raise RequestError(f"{missing[0]} does not wait in {self.settings.name}; there wait: {', '.join(waiting)}")
        self.loop.reorder([waiting[each] for each in dict.fromkeys(first)])

    def stop(self, operation: str | None, reason: str) -> None:
        """Stop an operation in the next tick, or all; may be called from other threads. It may have ended before."""
        if operation is None:
            self.loop.stop(reason)
        elif (submitted := self._operations.get(operation)) is not None:
            self.loop.stop(reason, submitted.run)

    def take_library(self, content: bytes) -> None:
        """Let operations that are submitted from now on run another library; its vocabulary has the same terms."""
        self.library = self.loop.library = decode_library(content)

    def take_snapshot(self, with_arms: bool = False) -> bytes:
        """Return what the cell knows now, encoded, and where its arms are; else the same while nothing is written."""
        if with_arms:
            return self._snapshots.take_with_arms(self.library, self.devices.backend.cell)
        return self._snapshots.take(self.library)

    def take_twin(self) -> bytes:
        """Return what the cell knows now and what its devices report, encoded: a twin of it is built from that."""
        return self._snapshots.take_twin(self.library, self.devices.backend.capabilities.checkpoints)

    def edit(self, wanted: Edit | Place) -> None:
        """Change the world in one transaction as a person states; RequestError if it is refused: nothing changes."""
        if self.loop.fault is not None:
            raise RequestError(f"the world of {self.settings.name} cannot be written: {self.loop.fault}")
        edit_world(self.world, wanted, self.loop, self._operations.values())

    def checkpoint(self, wanted: CheckpointCommand) -> None:
        """Reset the cell to its scene, save or restore it; RequestError or DiagnosticsError if that is not possible."""
        if self._operations:
            going = ", ".join(self._operations)
            raise RequestError(f"{going} goes on or waits in {self.settings.name}; stop it, or wait until it has ended")
        if self.loop.fault is not None:
            raise RequestError(f"the journal of {self.settings.name} cannot be written: {self.loop.fault}")
        self._checkpoints.carry_out(wanted, self.world, self.library)
        self.loop.backend = self.devices.backend
        self._resets += isinstance(wanted, Reset | Restore)
        self._condition.update()
        self._commit()

    def disturb(self, disturbance: Disturbance, who: str) -> None:
        """Let something happen to a simulated cell; RequestError if it is not possible."""
        found = disturb_cell(disturbance, self.settings.name, self.devices.backend, self.world.snapshot())
        self.devices.keeper.has_changed()
        event = Disturbed(time=self.loop.backend.clock.now, disturbance=found, tick=self.loop.ticks, who=who)
        for submitted in self._operations.values():
            submitted.publisher(event)
        self._condition.update()

    def take_changed(self) -> tuple[OperationStatus, ...]:
        """Return the operations that have changed since this was called last.

        Those that have ended are forgotten; how they ended is in the journal.
        """
        changed = []
        places = {each.id: place for place, each in enumerate((each for each in self.loop.runs if each.waits), 1)}
        for submitted in tuple(self._operations.values()):
            self._recordings.update(submitted)
            operation = submitted.describe(self.settings.name, places.get(submitted.run.id, 0))
            if operation.state == "interrupted":
                operation = structs.replace(operation, decisions=decisions_about(operation.id, self._reader))
            if operation != submitted.reported:
                submitted.reported = operation
                changed.append(operation)
        if ended := [each for each in changed if each.state in ENDS]:
            for each in ended:
                self._journal.end_operation(each)
                self._recordings.end(each.id)
                del self._operations[each.id]
            self.loop.obey()
        return tuple(changed)

    def tick(self) -> bool:
        """Do one tick; return whether anything happened."""
        happened = self.loop.tick()
        self._condition.update()
        return happened

    def obey(self) -> None:
        """Take requests while no tick is due, and look whether devices have stopped by themselves."""
        self.loop.obey()
        self._condition.update()

    def close(self, reason: str) -> None:
        """End all operations at once, and release the devices; an end that cannot be written is, at the next start."""
        self.loop.close(reason)
        with suppress(NotDurable):
            self._commit()
        self._recordings.close()
        self.devices.backend.close()

    def _commit(self) -> None:
        """Make durable what has happened, with the reality in which it did; NotDurable if that is not possible."""
        self.devices.keeper.keep(standing=not self.loop.runs)
        self._evidence.keep()
        self._journal.commit()

    def _continue(self, operation: str, request: OperationRequest) -> None:
        """Submit an operation that continues another one, and note that at the other one."""
        if any(each.request.continues == request.continues for each in self._operations.values()):
            raise RequestError(f"{request.continues} is being continued")
        try:
            earlier = find_interrupted(request, self._reader)
            request = take_over(request, earlier.request)
            continuation = prepare_continuation(request, self._assign(request), self._reader, self.library)
        except DatabaseError as error:
            raise RequestError(str(error)) from error
        submitted = self._submit(operation, request, continuation)
        if continuation.assumed:
            with recorded_changes(self.world, submitted.publisher, self.loop.backend.clock.now):
                self.world.commit(continuation.assumed, f"{request.owner}: {request.why}", "assumed")
        assert earlier.ended is not None, "it was interrupted"
        self._journal.end_operation(structs.replace(earlier.ended, decisions=(), continued_by=operation))

    def _submit(self, operation: str, request: OperationRequest, continuation: Continuation) -> SubmittedOperation:
        """Submit a run to the loop."""
        gate, origin = make_gate(request, self.library), self.loop.origin
        spec = specify(request, origin.scene, origin.seed, origin.backend)
        prepared, plan = continuation.prepared, self._plans.queue(partial(self._plan, geometry=request.geometry))
        start = plan if prepared is None else prepare_after(prepared, plan)
        account, submitted_ns = RunAccount(), time.time_ns()
        self._journal.add_operation(operation, request, submitted_ns)
        beginning = self.devices.begin(self._operations)
        self.loop.backend = self.devices.backend
        self._recordings.note_company(operation)
        recorders = self._recordings.begin(operation, request, self.library, beginning, self.loop.ticks)
        publisher = Publisher(operation, (account, self._journal.record, *recorders))
        run = self.loop.submit(continuation.assignment, (publisher,), spec, gate, operation, start)
        submitted = SubmittedOperation(request, submitted_ns, run, publisher, account, self.library.hash)
        self._operations[operation] = submitted
        return submitted

    def _assign(self, request: OperationRequest) -> Assignment:
        state = self.world.snapshot()
        return assign_request(request.task, request.goal, request.call, request.arguments, self.library, state)

    def _plan(self, assignment: Assignment, failures: FailedSteps, geometry: bool = True) -> PlanningJob:
        backend = self.devices.backend
        looks = geometry and not backend.capabilities.symbolic
        look = look_from(backend.cell, failures.library) if looks else None
        return PlanningJob(assignment, failures.library, failures, look=look)
