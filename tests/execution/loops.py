"""Loops over cells of tests: what their runs told, a planner whose answers arrive when the test wants, and a stage."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, field
from typing import TypeVar

from own_backend import OwnBackend
from skillc_model import tree
from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.backend import Backend, BackendBroken
from skillc_runtime.execution.assignment import Assignment, ExecuteBody, NotStarted, PreparedTask
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.task_planning import replan_task
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.execution.task_state import RefusedCommand
from skillc_runtime.execution.tree.gate import Gate
from skillc_runtime.planning.schedule import Planners
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.recording.commands import Command
from skillc_runtime.recording.events import Event, StateChanged, TaskEnded
from skillc_runtime.recording.run_spec import RunSpec
from tree.library import Library, world
from tree.stage import Script, Stage

E = TypeVar("E", bound=Event)
B = TypeVar("B", bound=Backend)

PLANNERS = Planners((AStar(),), None)


@dataclass
class StagedCell(OwnBackend, Stage):
    """A stage whose time the loop moves; devices come to rest `settle_s` after the last call of `secure`."""

    settle_s: float = 0.0
    secured: list[frozenset[str] | None] = field(default_factory=list)
    meanwhile: Callable[[], None] = lambda: None
    _rest_at: float = 0.0

    def is_at_rest(self, devices: Collection[str] | None = None) -> bool:
        """Whether everything is at rest."""
        return self.now >= self._rest_at

    def advance(self, seconds: float) -> None:
        """Let time pass."""
        if self.broken is not None:
            raise BackendBroken(self.broken)
        self.now += seconds
        self.meanwhile()

    def secure(self, devices: Collection[str] | None = None) -> tuple[str, ...]:
        """Note what was secured."""
        self.secured.append(None if devices is None else frozenset(devices))
        self._rest_at = self.now + self.settle_s
        return ()


@dataclass
class LatePlan:
    """An answer that arrives when it has been looked for `looks` times."""

    answer: PreparedTask | NotStarted
    looks: int
    killed: bool = False
    waits_for: str = ""

    def poll(self) -> PreparedTask | NotStarted | None:
        """Return the answer once it has arrived."""
        self.looks -= 1
        return self.answer if self.looks < 0 else None

    def wait(self, seconds: float) -> PreparedTask | NotStarted | None:
        """Wait for nothing."""
        return None

    def kill(self) -> None:
        """Note it."""
        self.killed = True


@dataclass
class LatePlanner:
    """Plans in this process; the `n`th answer arrives when it has been looked for `looks[n]` times, then at once."""

    library: SkillLibrary
    looks: list[int] = field(default_factory=list)
    plans: list[LatePlan] = field(default_factory=list)

    def __call__(self, assignment: Assignment, failures: FailedSteps) -> LatePlan:
        answer = replan_task(assignment, self.library, failures, PLANNERS)
        self.plans.append(LatePlan(answer, self.looks.pop(0) if self.looks else 0))
        return self.plans[-1]


@dataclass
class Watched:
    """A run in its loop, and what it told."""

    loop: CellLoop
    run: TaskRun
    events: list[Event]

    @property
    def states(self) -> list[str]:
        """The states that the run entered, without repetition, and its end."""
        entered = [event.state for event in self.events if isinstance(event, StateChanged)]
        ends = [event.status for event in self.events if isinstance(event, TaskEnded)]
        return [
            state for number, state in enumerate(entered) if entered[max(number - 1, 0)] != state or not number
        ] + ends

    def told(self, kind: type[E]) -> list[E]:
        """Return the events of a kind."""
        return [event for event in self.events if isinstance(event, kind)]

    def request(self, command: Command) -> RefusedCommand | None:
        """Request something and do the tick in which it takes effect; return why it was refused."""
        request = self.loop.request(self.run, command)
        self.loop.tick()
        assert request.answered
        return request.refused

    def tick(self) -> None:
        """Do one tick; wait for what skills compute, if nothing else goes on."""
        if not self.loop.tick() and self.run.computing:
            self.loop.wait(10.0)

    def until(self, state: str, ticks: int = 2000) -> Watched:
        """Tick until the run is in a state."""
        for _ in range(ticks):
            if self.run.state == state:
                return self
            self.tick()
        raise AssertionError(f"it is {self.run.state} ({self.run.reason}), and not {state}")

    def until_end_or(self, state: str, ticks: int = 2000) -> Watched:
        """Tick until the run has ended or is in a state."""
        for _ in range(ticks):
            if self.run.ended or self.run.state == state:
                return self
            self.tick()
        raise AssertionError(f"it is {self.run.state} ({self.run.reason}), and neither {state} nor has it ended")

    def until_end(self, ticks: int = 20000) -> str:
        """Tick until the run has ended; return how."""
        for _ in range(ticks):
            if self.run.end is not None:
                return self.run.end
            self.tick()
        raise AssertionError(f"it does not end; it is {self.run.state}: {self.run.reason}")


def submit(
    loop: CellLoop, assignment: Assignment, settings: RunSpec | None = None, gate: Gate | None = None
) -> Watched:
    """Submit a run to a loop."""
    events: list[Event] = []
    return Watched(loop, loop.submit(assignment, [events.append], settings, gate), events)


def staged(
    body: tree.Node,
    settings: RunSpec | None = None,
    *,
    library: Library | None = None,
    looks: tuple[int, ...] = (),
    settle_s: float = 0.0,
    gate: Gate | None = None,
    since_s: float = 0.0,
    within_s: float | None = None,
    **scripts: Script,
) -> tuple[StagedCell, Watched]:
    """Return a run of a body on a stage, which was submitted at a time of the stage, and the stage."""
    cell = StagedCell(world(), {name: [script] for name, script in scripts.items()}, since_s, settle_s=settle_s)
    built = (library or Library()).build()
    loop = CellLoop(cell, built, LatePlanner(built, list(looks)))  # type: ignore[arg-type]
    assignment = Assignment("act", cell.world.snapshot(), ExecuteBody(body), within_s=within_s)
    return cell, submit(loop, assignment, settings, gate)
