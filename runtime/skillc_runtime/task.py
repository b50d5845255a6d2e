"""A task from its scene and its goal to its end: the whole runtime on one page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from time import perf_counter
from typing import assert_never

from skillc_compiler.library.conditions import Condition
from skillc_compiler.library.skills import SkillLibrary
from skillc_compiler.library.tree import Node
from skillc_runtime.planning.plan import Solved
from skillc_runtime.planning.problem import GoalError
from skillc_runtime.planning.solve import solve
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.selection.preflight import preflight
from skillc_runtime.simulation.cell import SimulatedCell
from skillc_runtime.trace.events import Listener, PlanMade, PlanStep, TaskEnded, TaskStarted
from skillc_runtime.trace.failure import Failure
from skillc_runtime.trace.outcome import Outcome
from skillc_runtime.tree.run import Run, plan_body
from skillc_runtime.world.state import WorldState

TICK_S = 0.01
"""The tree ticks at 100 Hz of the cell's time, between ten control periods each."""

SETTLE_S = 5.0
"""After the end everything that moves gets this long to come to rest and to let go of what it pushed."""


@dataclass(frozen=True, slots=True)
class Reach:
    """A goal to plan for."""

    goal: Condition


@dataclass(frozen=True, slots=True)
class Perform:
    """A body to run as it stands."""

    body: Node


@dataclass(frozen=True, slots=True)
class Assignment:
    """What is to be done in a world."""

    name: str
    state: WorldState
    aim: Reach | Perform


@dataclass(frozen=True, slots=True)
class Prepared:
    """An assignment with the body that will run; `solved` is how it was planned, None where it was given."""

    assignment: Assignment
    body: Node
    solved: Solved | None


@dataclass(frozen=True, slots=True)
class Refused:
    """A task that does not start, and why."""

    why: str


@dataclass(frozen=True, slots=True)
class Execution:
    """What became of a prepared task: how its run ended, its tree, the cell it left behind, how long it took."""

    prepared: Prepared
    status: Status
    failure: Failure | None
    tree: Outcome
    cell: SimulatedCell
    wall_time_s: float


def prepare(assignment: Assignment, library: SkillLibrary) -> Prepared | Refused:
    """Plan if there is a goal, and look for everything that would keep the body from running, before anything moves."""
    match assignment.aim:
        case Reach(goal):
            prepared = _planned(assignment, goal, library)
        case Perform(body):
            prepared = Prepared(assignment, body, None)
        case _:
            assert_never(assignment.aim)
    if isinstance(prepared, Refused):
        return prepared
    refusals = preflight(prepared.body, library, assignment.state)
    return Refused("\n".join(map(str, refusals))) if refusals else prepared


def _planned(assignment: Assignment, goal: Condition, library: SkillLibrary) -> Prepared | Refused:
    try:
        answer = solve(library, assignment.state, goal)
    except GoalError as error:
        return Refused(str(error))
    if not isinstance(answer, Solved):
        return Refused(answer.why)
    body = plan_body([(step.skill, step.arguments) for step in answer.plan.steps], library)
    return Prepared(assignment, body, answer)


def execute(
    prepared: Prepared,
    library: SkillLibrary,
    cell: SimulatedCell,
    listeners: Sequence[Listener] = (),
    watch: Callable[[], None] = lambda: None,
    interrupted: Callable[[], bool] = lambda: False,
) -> Execution:
    """Run a prepared task to its end; `watch` is called after every tick.

    When `interrupted` becomes true everything is halted: what pushed lets go, what yielded is stiff again.
    """
    began = perf_counter()
    run = Run(prepared.body, library, cell, listeners)
    _tell(listeners, prepared, library, cell)
    while run.tick() is Status.RUNNING:
        if interrupted():
            run.halt("interrupted")
        else:
            _advance(cell, TICK_S, run)
            watch()
    _settle(cell, run)
    for listener in listeners:
        listener(TaskEnded(time=cell.now, task=prepared.assignment.name, status=run.status.value, failure=run.failure))
    return Execution(prepared, run.status, run.failure, run.outcome, cell, perf_counter() - began)


def _settle(cell: SimulatedCell, run: Run) -> None:
    for _ in range(round(SETTLE_S / TICK_S)):
        if cell.at_rest:
            return
        _advance(cell, TICK_S, run)


def _advance(cell: SimulatedCell, seconds: float, run: Run) -> None:
    """Let time pass; whatever breaks in the cell fails the run, which halts everything that runs."""
    try:
        cell.advance(seconds)
    except Exception as error:  # noqa: BLE001  the task's boundary: it reports, halts and ends
        run.abort(error)


def _tell(listeners: Sequence[Listener], prepared: Prepared, library: SkillLibrary, cell: SimulatedCell) -> None:
    events: list[TaskStarted | PlanMade] = [
        TaskStarted(time=cell.now, task=prepared.assignment.name, library=library.name, hash=library.hash)
    ]
    if prepared.solved is not None:
        solved = prepared.solved
        steps = tuple(
            PlanStep(skill=step.skill, arguments=step.arguments, source=library.skills[step.skill].source)
            for step in solved.plan.steps
        )
        cost = solved.plan.duration_s
        events.append(PlanMade(time=cell.now, planner=solved.planner, optimal=solved.optimal, cost=cost, steps=steps))
    for event in events:
        for listener in listeners:
            listener(event)
