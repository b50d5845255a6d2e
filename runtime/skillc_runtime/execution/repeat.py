"""Repeats a recorded run from its inputs: requests and plans take effect again at their ticks of the loop."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from msgspec.structs import replace

from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.disturbances import Disturbance, DisturbanceRefused
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody, NotStarted, PreparedTask
from skillc_runtime.execution.attempt import TICK_S, CellOrigin
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.run_events import read_arrival
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.execution.tree.gate import Gate, read_breakpoint
from skillc_runtime.planning.progress import PlanningProgress
from skillc_runtime.planning.validation import PlanError
from skillc_runtime.recording.events import Disturbed, Event, Listener, PlanArrived, Requested, TaskEnded, TaskStarted

COMPUTING_S = 1.0
"""How long a repetition waits for what skills compute before it looks again, in s of wall time."""


class NotRepeatable(Exception):
    """A recorded run cannot be repeated; the message says why."""


@dataclass(frozen=True, slots=True)
class Divergence:
    """Where a repetition differs: the event with this number, from 1, as recorded and as repeated; None for none."""

    number: int
    recorded: Event | None
    repeated: Event | None

    def __str__(self) -> str:
        return f"event {self.number} was {_describe(self.recorded)}, and is {_describe(self.repeated)} when repeated"


@dataclass(frozen=True, slots=True)
class Repetition:
    """The events of a repeated run, up to the first that differs from the recording, and the difference, if any.

    `run` is the task run that was made again; it has ended only if the recorded one has.
    """

    events: tuple[Event, ...]
    difference: Divergence | None
    run: TaskRun | None = field(default=None, compare=False, repr=False)

    @property
    def ended(self) -> bool:
        """Whether the end of the run was repeated."""
        return bool(self.events) and isinstance(self.events[-1], TaskEnded)


def repeat_run(
    recorded: Sequence[Event],
    library: SkillLibrary,
    backend: Backend,
    listeners: Sequence[Listener] = (),
    after_tick: Sequence[Callable[[], None]] = (),
    disturb: Callable[[Disturbance], None] | None = None,
    ticks: int = 0,
) -> Repetition:
    """Run a task again as `recorded`, all events of one run; `backend` is a cell as it was at its start.

    `ticks` is the number of its first tick.

    `listeners` get its events, `after_tick` are called whenever time has passed. `disturb` lets the recorded
    disturbances happen to the cell.

    A recording that ends before its run, or because the process died, is repeated up to its last event. Only a run that
    had its cell for itself can be repeated. NotRepeatable if the cell is not as old as that of the run, if the library
    is another one, if a plan of the recording does not work with it, or if the cell cannot be disturbed as it was.
    """
    player = _Player(recorded, library, backend, listeners, after_tick, disturb, ticks)
    try:
        player.play()
    except PlanError as error:
        raise NotRepeatable(f"a plan of the recording does not work in this cell: {error}") from error
    finally:
        repetition = Repetition(tuple(player.events), player.difference, player.run)
        player.loop.close("the repetition ends")
    return repetition


class _Player:
    """Feeds the inputs of a recording to a run in a loop of its own, and compares what it tells."""

    def __init__(
        self,
        recorded: Sequence[Event],
        library: SkillLibrary,
        backend: Backend,
        listeners: Sequence[Listener],
        after_tick: Sequence[Callable[[], None]],
        disturb: Callable[[Disturbance], None] | None,
        ticks: int,
    ) -> None:
        started = _find_start(recorded, library, backend)
        self.events: list[Event] = []
        self.difference: Divergence | None = None
        self._is_whole = _has_end(recorded)
        self._recorded = tuple(recorded if self._is_whole else _without_end(recorded))
        self._library, self._backend = library, backend
        self._inputs = deque(event for event in recorded if isinstance(event, Requested | Disturbed))
        self._disturb, self._listeners = disturb, (self._compare, *listeners)
        self._arrivals = deque(event for event in recorded if isinstance(event, PlanArrived))
        origin = CellOrigin(started.scene, started.seed, started.backend)
        self.loop = CellLoop(backend, library, self._prepare, origin, after_tick, ticks=ticks)
        gate = Gate(map(read_breakpoint, started.breakpoints), started.settings.confirm_steps)
        if started.stepped:
            gate.step("into", ())
        self.run = self.loop.submit(_make_assignment(started, backend), self._listeners, started.settings, gate)

    def play(self) -> None:
        """Tick until the run has ended, or is not as recorded."""
        while self.difference is None and not self.run.ended and (self._is_whole or self._remain):
            while self._inputs and self._inputs[0].tick <= self.loop.ticks:
                self._feed(self._inputs.popleft())
            computing, happened = self.loop.is_computing, self.loop.tick()
            if computing and not happened:
                self.loop.wait(COMPUTING_S)
            else:
                self._find_missing(at_end=not happened)
        self._find_missing(at_end=True)

    def _feed(self, event: Requested | Disturbed) -> None:
        """Let an input take effect in the next tick, after those before it. NotRepeatable if that is not possible."""
        if isinstance(event, Requested):
            self.loop.request(self.run, event.command)
            return
        if self._disturb is None:
            raise NotRepeatable("the cell of the run was disturbed, and this one cannot be")
        self.loop.obey()
        try:
            self._disturb(event.disturbance)
        except DisturbanceRefused as error:
            raise NotRepeatable(f"the cell cannot be disturbed as it was: {error}") from error
        for listener in self._listeners:
            listener(replace(event, time=self._backend.clock.now))

    @property
    def _remain(self) -> bool:
        """Whether some recorded events have not happened yet."""
        return len(self.events) < len(self._recorded)

    def _compare(self, event: Event) -> None:
        """Compare an event with the recorded one; those after a recording that was cut off are not known."""
        if self.difference is None and (self._is_whole or self._remain):
            number = len(self.events)
            recorded = self._recorded[number] if number < len(self._recorded) else None
            self.events.append(event)
            if event != recorded:
                self.difference = Divergence(number + 1, recorded, event)

    def _find_missing(self, at_end: bool) -> None:
        """Find the next recorded event missing, if there is one, once its time has passed or nothing can follow."""
        number = len(self.events)
        if self.difference is None and number < len(self._recorded):
            missing = self._recorded[number]
            if at_end or missing.time < self._backend.clock.now - 1.5 * TICK_S:
                self.difference = Divergence(number + 1, missing, None)

    def _prepare(self, assignment: Assignment, failures: FailedSteps) -> _RecordedPlan:
        arrival = self._arrivals.popleft() if self._arrivals else None
        return _RecordedPlan(assignment, self._library, arrival, lambda: self.loop.ticks)


@dataclass(frozen=True, slots=True)
class _RecordedPlan:
    """A preparation whose answer arrives in its recorded tick; never without one."""

    assignment: Assignment
    library: SkillLibrary
    arrival: PlanArrived | None
    ticks: Callable[[], int]
    waits_for: str = ""
    progress: PlanningProgress | None = None

    def poll(self) -> PreparedTask | NotStarted | None:
        """Return the answer in its tick; PlanError if the plan does not work."""
        if self.arrival is None or self.ticks() < self.arrival.tick:
            return None
        return read_arrival(self.arrival, self.assignment, self.library)

    def wait(self, seconds: float) -> PreparedTask | NotStarted | None:
        """Return what there is; nothing is computed meanwhile."""
        return self.poll()

    def kill(self) -> None:
        """Do nothing: nobody plans."""


def _has_end(recorded: Sequence[Event]) -> bool:
    """Whether the last event is the end of the run, and came from the run itself."""
    return isinstance(recorded[-1], TaskEnded) and recorded[-1].status != "interrupted"


def _without_end(recorded: Sequence[Event]) -> Sequence[Event]:
    """Return the events without the end that was written for a process that died."""
    return recorded[:-1] if isinstance(recorded[-1], TaskEnded) else recorded


def _find_start(recorded: Sequence[Event], library: SkillLibrary, backend: Backend) -> TaskStarted:
    """Return the first event; NotRepeatable if it does not fit the library or the cell."""
    if not recorded or not isinstance(recorded[0], TaskStarted):
        raise NotRepeatable("the recording does not begin with the start of a task")
    started = recorded[0]
    if started.hash != library.hash:
        raise NotRepeatable(
            f"the run used the library {started.library} {started.hash[:12]}, and this is {library.name} "
            f"{library.hash[:12]}; repeat it with the library that it used"
        )
    if started.time != backend.clock.now:
        raise NotRepeatable(
            f"the run began at {started.time:g} s of its cell, and the recording does not have how the cell was then"
        )
    return started


def _make_assignment(started: TaskStarted, backend: Backend) -> Assignment:
    state, limits = backend.cell.world.snapshot(), (started.within_s, started.always, started.parts)
    if started.goal is not None and started.minimise:
        return Assignment(started.task, state, AchieveGoal(started.goal, started.minimise), None, *limits)
    if started.body is not None:
        return Assignment(started.task, state, ExecuteBody(started.body), None, *limits)
    raise NotRepeatable("the start of the task has neither a goal nor a body")


def _describe(event: Event | None) -> str:
    return "nothing" if event is None else repr(event)
