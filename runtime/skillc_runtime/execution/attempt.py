"""One attempt at a task: a body runs in a cell from its first tick until everything is at rest."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.cell import Cell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, PlannedSteps, PreparedTask
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.plans.progress import invalidation_reason, measure_progress
from skillc_runtime.execution.success_facts import Claim
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.planning.plan import describe_quality
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.events import Listener, Note, PlanMade, PlanStep
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.listeners import Listeners
from skillc_runtime.recording.node_outcome import NodeOutcome
from skillc_runtime.world.state.labelled import label
from skillc_runtime.world.state.world_state import WorldState

TICK_S = 0.01
"""The tree is ticked at 100 Hz of the cell's time: every ten control periods."""

SETTLE_S = 5.0
"""How long, after the end, everything that moves may take to come to rest."""


class SteppedCell(Cell, Protocol):
    """A cell whose time passes only in `advance`."""

    def is_at_rest(self) -> bool:
        """Whether nothing moves any more."""
        ...

    def advance(self, seconds: float) -> None:
        """Let time pass, in s; raises if the cell breaks."""
        ...

    def secure(self) -> Sequence[str]:
        """Stop everything, release all forces and make the arms stiff; return what had to be corrected."""
        ...


@dataclass(frozen=True, slots=True)
class RunContext:
    """What all attempts at a task share.

    `after_tick` is called after every tick; when `interrupted` returns true everything is halted. `failures` collects
    the steps of plans that fail.
    """

    library: SkillLibrary
    cell: SteppedCell
    listeners: Sequence[Listener]
    after_tick: Callable[[], None]
    interrupted: Callable[[], bool]
    failures: FailedSteps


@dataclass(frozen=True, slots=True)
class AttemptResult:
    """How a body ended, its tree and the number of its last node.

    `invalidated` says why the plan no longer led to the goal, if it was halted for that. `claims` are the posts of the
    outermost calls that succeeded.
    """

    prepared: PreparedTask
    status: Status
    failure: Failure | None
    tree: NodeOutcome
    last_node: int
    invalidated: str | None
    claims: tuple[Claim, ...] = ()

    @property
    def reason(self) -> str:
        """Why another plan may be needed."""
        if self.invalidated is not None:
            return f"the plan no longer leads to the goal: {self.invalidated}"
        return self.failure.message if self.failure else "the goal does not hold after the plan"


def run_attempt(prepared: PreparedTask, context: RunContext, nodes_before: int) -> AttemptResult:
    """Run a body until it ends or its plan becomes invalid; then wait until everything is at rest.

    The nodes of its tree are numbered from `nodes_before` + 1.
    """
    cell = context.cell
    _emit_plan(prepared, context)
    failures = None if prepared.planned is None else context.failures
    run = TreeRun(prepared.body, context.library, cell, context.listeners, None, nodes_before, failures)
    try:
        invalidated = _tick_until_ended(run, prepared, context)
    finally:
        run.halt("the program ends")
        _emit_notes(cell.secure(), context)
    _wait_until_at_rest(cell, run)
    run.check_devices()
    return AttemptResult(prepared, run.status, run.failure, run.outcome, run.last_node, invalidated, run.claims)


def _tick_until_ended(run: TreeRun, prepared: PreparedTask, context: RunContext) -> str | None:
    """Tick until the run has ended; return why its plan became invalid, if it did."""
    cell, invalidated = context.cell, None
    seen = cell.world.snapshot()
    while run.tick() is Status.RUNNING:
        if cell.world.snapshot() is not seen:
            seen = cell.world.snapshot()
            invalidated = _check_plan(run, prepared, context.library, seen)
        if context.interrupted():
            run.halt("interrupted")
        elif invalidated is not None:
            run.halt(f"the plan no longer leads to the goal: {invalidated}")
        else:
            _advance(cell, TICK_S, run)
            context.after_tick()
    return invalidated


def _emit_notes(messages: Sequence[str], context: RunContext) -> None:
    emit = Listeners(context.listeners)
    for message in messages:
        emit(Note(time=context.cell.now, message=message))


def _emit_plan(prepared: PreparedTask, context: RunContext) -> None:
    if prepared.planned is None:
        return
    solved, skills = prepared.planned.solved, context.library.skills
    steps = tuple(
        PlanStep(
            skill=step.skill,
            arguments={name: label(iri, context.library.vocabulary) for name, iri in step.arguments.items()},
            source=skills[step.skill].source,
        )
        for step in solved.plan.steps
    )
    event = PlanMade(
        time=context.cell.now,
        planner=solved.planner,
        optimal=solved.optimal,
        cost=solved.plan.duration_s,
        steps=steps,
        quality=describe_quality(solved.optimal, solved.left_out, solved.at_least_s),
    )
    Listeners(context.listeners)(event)


def _check_plan(run: TreeRun, prepared: PreparedTask, library: SkillLibrary, state: WorldState) -> str | None:
    """Return why the rest of a plan no longer leads to the goal; None if it does, or if nothing was planned."""
    match prepared:
        case PreparedTask(Assignment(objective=AchieveGoal(goal)), planned=PlannedSteps(steps=steps)):
            return invalidation_reason(measure_progress(steps, run.outcome), goal, library, state)
        case _:
            return None


def _wait_until_at_rest(cell: SteppedCell, run: TreeRun) -> None:
    for _ in range(round(SETTLE_S / TICK_S)):
        if cell.is_at_rest():
            return
        _advance(cell, TICK_S, run)


def _advance(cell: SteppedCell, seconds: float, run: TreeRun) -> None:
    """Let time pass; an error of the cell fails the run, which halts everything."""
    try:
        cell.advance(seconds)
    except Exception as error:  # noqa: BLE001  the task's boundary: it reports, halts and ends
        run.abort(error)
