"""A task from its scene and its goal to its end: the whole runtime on one page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from time import perf_counter

from skillc_compiler.library.conditions import Condition
from skillc_compiler.library.skills import SkillLibrary
from skillc_compiler.library.tree import Node
from skillc_runtime.controllers.controller import ControlError
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

SETTLE_S = 0.5
"""After the end the arm still gets this long to come to rest and let go of what it pushed."""


@dataclass(frozen=True, slots=True)
class Assignment:
    """What is to be done in a world: reach a goal, or run a body as it stands; one of the two is None."""

    name: str
    state: WorldState
    goal: Condition | None = None
    body: Node | None = None


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
    solved: Solved | None = None
    body = assignment.body
    if assignment.goal is not None:
        try:
            answer = solve(library, assignment.state, assignment.goal)
        except GoalError as error:
            return Refused(str(error))
        if not isinstance(answer, Solved):
            return Refused(answer.why)
        solved = answer
        body = plan_body([(step.skill, step.arguments) for step in solved.plan.steps], library)
    if body is None:
        return Refused(f"{assignment.name} has neither a goal nor a body")
    refusals = preflight(body, library, assignment.state)
    if refusals:
        return Refused("\n".join(map(str, refusals)))
    return Prepared(assignment, body, solved)


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
    _advance(cell, SETTLE_S, run)
    for listener in listeners:
        listener(TaskEnded(time=cell.now, task=prepared.assignment.name, status=run.status.value, failure=run.failure))
    return Execution(prepared, run.status, run.failure, run.outcome, cell, perf_counter() - began)


def _advance(cell: SimulatedCell, seconds: float, run: Run) -> None:
    """Let time pass; a controller that gives up ends the run, which halts everything that runs."""
    try:
        cell.advance(seconds)
    except ControlError as error:
        run.halt(str(error))


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
