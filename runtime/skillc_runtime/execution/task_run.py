"""Runs a task to its end: prepare, attempt, and replan while another plan may succeed."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Generic, TypeVar

from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.assignment import (
    AchieveGoal,
    ExecuteBody,
    NotStarted,
    PreparedTask,
    replan_task,
)
from skillc_runtime.execution.attempt import AttemptResult, RunContext, SteppedCell, run_attempt
from skillc_runtime.execution.plans.failed_steps import FailedSteps
from skillc_runtime.execution.plans.progress import measure_progress
from skillc_runtime.execution.success_facts import collect_success_facts
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.events import FORMAT, Listener, Replanned, TaskEnded, TaskStarted
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.known_facts import KnownFact, assumed_facts
from skillc_runtime.recording.listeners import Listeners
from skillc_runtime.recording.states import EndState
from skillc_runtime.world.eval.conditions import evaluate

MAX_ATTEMPTS = 4
"""How many plans are tried for one goal."""

_END_STATES: Mapping[Status, EndState] = {
    Status.SUCCESS: "succeeded",
    Status.FAILURE: "failed",
    Status.HALTED: "stopped",
}

CellT = TypeVar("CellT", bound=SteppedCell)


@dataclass(frozen=True, slots=True)
class Execution(Generic[CellT]):
    """How a task ended: its attempts, the cell it ran in, the wall-clock time it took.

    `facts` are those that a success rests on.
    """

    attempts: tuple[AttemptResult, ...]
    status: EndState
    failure: Failure | None
    cell: CellT
    wall_time_s: float
    facts: tuple[KnownFact, ...] = ()

    @property
    def verified(self) -> bool | None:
        """Whether a success rests on no fact that is only assumed; None if the task did not succeed."""
        return _is_verified(self.status, self.facts)

    @property
    def last(self) -> AttemptResult:
        """The attempt that ended the task."""
        return self.attempts[-1]


def execute_task(
    prepared: PreparedTask,
    library: SkillLibrary,
    cell: CellT,
    listeners: Sequence[Listener] = (),
    after_tick: Callable[[], None] = lambda: None,
    interrupted: Callable[[], bool] = lambda: False,
) -> Execution[CellT]:
    """Run a prepared task to its end; `after_tick` is called after every tick.

    A plan that fails, or that no longer leads to the goal because the world changed, is replaced by a new one;
    `MAX_ATTEMPTS` plans are tried. An implementation that failed is not tried again until something that it depends on
    has changed. When `interrupted` returns true everything is halted, forces are released and arms are stiff again.
    """
    began = perf_counter()
    emit, name = Listeners(listeners), prepared.assignment.name
    context = RunContext(library, cell, listeners, after_tick, interrupted, FailedSteps(library))
    emit(TaskStarted(time=cell.now, format=FORMAT, task=name, library=library.name, hash=library.hash))
    attempts = [run_attempt(prepared, context, 0)]
    while isinstance(following := _next_attempt(attempts, context), PreparedTask):
        emit(Replanned(time=cell.now, reason=attempts[-1].reason))
        attempts.append(run_attempt(following, context, attempts[-1].last_node))
    status, failure = _final_status(attempts[-1], following)
    facts = _success_facts(attempts[-1], cell) if status == "succeeded" else ()
    verified = _is_verified(status, facts)
    emit(TaskEnded(time=cell.now, task=name, status=status, failure=failure, verified=verified, facts=facts))
    return Execution(tuple(attempts), status, failure, cell, perf_counter() - began, facts)


def _success_facts(last: AttemptResult, cell: SteppedCell) -> tuple[KnownFact, ...]:
    """Return the facts that a success rests on: those of the goal, or of the posts of the body's calls."""
    match last.prepared.assignment.objective:
        case AchieveGoal(goal):
            return collect_success_facts([(goal, {})], cell.world)
        case ExecuteBody():
            return collect_success_facts(last.claims, cell.world)


def _is_verified(status: EndState, facts: tuple[KnownFact, ...]) -> bool | None:
    return None if status != "succeeded" else not assumed_facts(facts)


def _next_attempt(attempts: Sequence[AttemptResult], context: RunContext) -> PreparedTask | NotStarted | None:
    """Return what to run next, why another plan is needed but there is none, or None if the task has ended."""
    last, assignment = attempts[-1], attempts[-1].prepared.assignment
    objective = assignment.objective
    if not isinstance(objective, AchieveGoal) or (last.status is Status.HALTED and last.invalidated is None):
        return None
    state = context.cell.world.snapshot()
    if last.status is Status.SUCCESS and evaluate(objective.goal, state, {}):
        return None
    if last.status is Status.FAILURE and not _has_failed_step(last, context.failures):
        return None
    if len(attempts) == MAX_ATTEMPTS:
        return NotStarted(f"the task was tried {MAX_ATTEMPTS} times")
    return replan_task(replace(assignment, state=state), context.library, context.failures)


def _has_failed_step(last: AttemptResult, failures: FailedSteps) -> bool:
    """Whether a step of the plan failed, or a body that was not planned: another plan may avoid it."""
    planned = last.prepared.planned
    if planned is None:
        return True
    return any(step in failures.steps for step in measure_progress(planned.steps, last.tree).with_status("failure"))


def _final_status(last: AttemptResult, refusal: NotStarted | None) -> tuple[EndState, Failure | None]:
    """Return how the last attempt ended, or a failure if another plan was needed and there was none."""
    if refusal is None:
        return _END_STATES[last.status], last.failure
    message = f"{last.reason}; no other plan was found: {refusal.reason}"
    source = last.failure.source if last.failure else None
    return "failed", Failure(kind="plan", message=message, source=source)
