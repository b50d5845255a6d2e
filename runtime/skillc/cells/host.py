"""A cell that runs: its loop, its world and its journal, for whoever ticks it and gives it operations."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path

import msgspec

from skillc.cells.interrupted import end_interrupted
from skillc.cells.journal.journal import CellJournal
from skillc.cells.journal.reading import JournalReader
from skillc.cells.operation import Operation, OperationRequest
from skillc.cells.world import restore_world
from skillc.services.assignments import assign_call, assign_goal, assign_task
from skillc.services.backends import BackendName, make_backend
from skillc.services.breakpoints import parse_breakpoints
from skillc.services.errors import RequestError
from skillc.services.libraries import compile_valid, find_task
from skillc.services.library_files import find_library, find_scene
from skillc.services.reporting import Reporter
from skillc.services.stores import StoreChoice, open_chosen_store, read_or_fill
from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.assignment import Assignment
from skillc_runtime.execution.attempt import CellOrigin
from skillc_runtime.execution.cell_loop import CellLoop, NotDurable
from skillc_runtime.execution.planning_job import PlanningJob
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.execution.tree.gate import Gate
from skillc_runtime.recording.commands import Command
from skillc_runtime.recording.publisher import Publisher
from skillc_runtime.recording.run_settings import RunSettings
from skillc_runtime.world.state.model import WorldModel


class CellSettings(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """A cell named `name` with the scene and the library in these files, which keeps its state in a folder.

    `seed` determines how the reality of a simulation differs from the scene.
    """

    name: str
    scene: str
    library: str
    folder: str
    backend: BackendName = "mujoco"
    seed: int = 0


class CellHost:
    """Carries out operations in a cell. `tick` is called again and again; nothing else lets time pass.

    The cell is the only one that writes to its world and its journal. What is submitted or requested takes effect in
    the next tick, and is durable when that ends.
    """

    def __init__(
        self, settings: CellSettings, library: SkillLibrary, world: WorldModel, journal: CellJournal, scene: Path
    ) -> None:
        """Build the cell; SheetError or FrameError if its scene cannot be simulated."""
        self.settings, self.library = settings, library
        self.world, self._journal = world, journal
        self._backend = make_backend(settings.backend, world, settings.seed)
        origin = CellOrigin(str(scene), settings.seed, settings.backend)
        self.loop = CellLoop(self._backend, library, self._plan, origin, commit=journal.commit)
        self._operations: dict[str, _Submitted] = {}

    @property
    def operations(self) -> tuple[Operation, ...]:
        """All operations since the cell was started, in the order of their submission."""
        return tuple(each.describe(self.settings.name) for each in self._operations.values())

    def submit(self, operation: str, request: OperationRequest) -> None:
        """Take an operation, with an id that no other has. RequestError or DiagnosticsError if it cannot be one."""
        if operation in self._operations:
            raise RequestError(f"there is already an operation {operation}")
        assignment = self._assign(request)
        gate = Gate(parse_breakpoints(request.breakpoints, self.library))
        if request.step:
            gate.step("into", ())
        settings = RunSettings(request.approve, request.deadline_s, request.ask_after_failure)
        self._journal.add_operation(operation, request)
        publisher = Publisher(operation, (self._journal.record,))
        run = self.loop.submit(assignment, (publisher,), settings, gate, operation)
        self._operations[operation] = _Submitted(request, run, publisher, self.library.hash)

    def find(self, operation: str) -> Operation:
        """Return an operation as it is now; RequestError if there is none of this id."""
        return self._find(operation).describe(self.settings.name)

    def request(self, operation: str, command: Command) -> None:
        """Give a command to an operation in the next tick; RequestError if there is no such operation."""
        self.loop.request(self._find(operation).run, command)

    def tick(self) -> bool:
        """Do one tick; return whether anything happened."""
        return self.loop.tick()

    def close(self, reason: str) -> None:
        """End all operations at once, and release the devices; an end that cannot be written is, at the next start."""
        self.loop.close(reason)
        with suppress(NotDurable):
            self._journal.commit()
        self._backend.close()

    def _find(self, operation: str) -> _Submitted:
        if operation not in self._operations:
            raise RequestError(f"there is no operation {operation} in {self.settings.name}")
        return self._operations[operation]

    def _assign(self, request: OperationRequest) -> Assignment:
        state = self.world.snapshot()
        match (request.task, request.goal, request.call):
            case (str(task), None, None):
                return assign_task(find_task(self.library, task), state)
            case (None, str(goal), None):
                return assign_goal(goal, self.library, state)
            case (None, None, str(call)):
                return assign_call(call, self.library, state)
            case _:
                raise RequestError("name exactly one of a task, a goal and a call")

    def _plan(self, assignment: Assignment, failures: FailedSteps) -> PlanningJob:
        return PlanningJob(assignment, self.library, failures)


class _Submitted:
    """An operation of a host."""

    def __init__(self, request: OperationRequest, run: TaskRun, publisher: Publisher, library_hash: str) -> None:
        self.request, self.run, self.publisher, self.library_hash = request, run, publisher, library_hash

    def describe(self, cell: str) -> Operation:
        run = self.run
        return Operation(
            id=run.id,
            cell=cell,
            request=self.request,
            state=run.state,
            reason=run.reason,
            allowed=run.allowed,
            events=self.publisher.sequence,
            verified=run.verified,
            failure=run.failure,
            library_hash=self.library_hash,
        )


@contextmanager
def open_cell(settings: CellSettings, reporter: Reporter) -> Iterator[CellHost]:
    """Start a cell where it ended: its world is that of its journal, and operations that had no end are interrupted.

    ServiceError, DiagnosticsError, StoreError, JournalError, SheetError or FrameError if that is not possible.
    """
    library, scene = compile_valid(find_library(Path(settings.library))), find_scene(Path(settings.scene))
    folder = Path(settings.folder)
    folder.mkdir(parents=True, exist_ok=True)
    choice = StoreChoice(str(folder / "world"))
    with closing(open_chosen_store(choice, str(folder / "world"), scene)) as store:
        state, sequence = read_or_fill(store, choice, scene, library.vocabulary, reporter)
        with closing(CellJournal(folder / "journal.sqlite", store)) as journal:
            with closing(JournalReader(folder / "journal.sqlite")) as reader:
                world = restore_world(store, state, sequence, journal, reader)
                end_interrupted(reader, journal)
            host = CellHost(settings, library, world, journal, scene)
            try:
                yield host
            finally:
                host.close("the cell ends")
