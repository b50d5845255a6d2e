"""Runs one task in a cell to its end: a short driver of a loop with one task run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from time import perf_counter
from typing import Generic, TypeVar

import msgspec

from skillc_dsl.garbage import old_objects_exempt
from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.backend import Backend
from skillc_runtime.execution.assignment import PreparedTask
from skillc_runtime.execution.attempt import AttemptResult
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.preparation import Preparation, Ready, StartPreparation, prepare_here
from skillc_runtime.execution.refinement.run_planning import SpaceLook
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.recording.events import Listener
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.known_facts import KnownFact
from skillc_runtime.recording.states import EndState

WAIT_S = 0.05
"""How long the driver waits for a plan before it looks for requests again, in s of wall time."""

BackendT = TypeVar("BackendT", bound=Backend)


class Execution(msgspec.Struct, Generic[BackendT], frozen=True):
    """How a task ended: its attempts, none if it never ran, the back-end of its cell, the wall-clock time it took.

    `facts` are those that a success rests on, `false_claims` sentences about what the world model claims that is not so
    in the simulator; `verified` is whether no fact is only assumed, and no claim is false.
    """

    task: str
    attempts: tuple[AttemptResult, ...]
    status: EndState
    failure: Failure | None
    backend: BackendT
    wall_time_s: float
    facts: tuple[KnownFact, ...] = ()
    verified: bool | None = None
    false_claims: tuple[str, ...] = ()

    @property
    def last(self) -> AttemptResult:
        """The attempt that ended the task."""
        return self.attempts[-1]


def execute_task(
    prepared: PreparedTask,
    library: SkillLibrary,
    backend: BackendT,
    listeners: Sequence[Listener] = (),
    after_tick: Callable[[], None] = lambda: None,
    interrupted: Callable[[], bool] = lambda: False,
    find_look: Callable[[], SpaceLook] | None = None,
) -> Execution[BackendT]:
    """Run a prepared task to its end; `after_tick` is called after every tick.

    A plan that fails, or that no longer leads to the goal because the world changed, is replaced by a new one, planned
    in this process, and looked at in space as `find_look` says then. When `interrupted` returns true everything is
    halted, and forces are released.
    """
    began = perf_counter()
    loop = make_loop(prepared, library, backend, after_tick, find_look)
    run = loop.submit(prepared.assignment, listeners)

    def stop_if_interrupted() -> bool:
        if run.state != "stopping" and interrupted():
            loop.stop("interrupted", run)
        return True

    drive(loop, run, stop_if_interrupted)
    return describe_execution(run, backend, perf_counter() - began)


def make_loop(
    prepared: PreparedTask,
    library: SkillLibrary,
    backend: Backend,
    after_tick: Callable[[], None] = lambda: None,
    find_look: Callable[[], SpaceLook] | None = None,
) -> CellLoop:
    """Return a loop of a cell that has what is prepared, and plans again in this process, as `execute_task` does."""
    start = prepare_after(Ready(prepared), prepare_here(library, find_look))
    return CellLoop(backend, library, start, after_tick=(after_tick,))


def drive(loop: CellLoop, run: TaskRun, attend: Callable[[], bool] = lambda: True) -> None:
    """Tick a loop until a run has ended; `attend` is called before each tick and returns whether the tick is due."""
    with old_objects_exempt():  # to look through what is there already takes many ticks
        try:
            while not run.ended:
                if attend() and not loop.tick():
                    loop.wait(WAIT_S)
        finally:
            loop.close("the program ends")


def describe_execution(run: TaskRun, backend: BackendT, wall_time_s: float) -> Execution[BackendT]:
    """Return how a run ended."""
    assert run.end is not None, "a run that has ended"
    return Execution(
        run.assignment.name,
        tuple(run.attempts),
        run.end,
        run.failure,
        backend,
        wall_time_s,
        run.facts,
        run.verified,
        run.false_claims,
    )


def prepare_after(first: Preparation, then: StartPreparation) -> StartPreparation:
    """Return what prepares an assignment: `first`, which has been started already, and after it what `then` starts."""
    started = [first]
    return lambda assignment, failures: started.pop() if started else then(assignment, failures)
