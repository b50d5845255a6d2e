"""A task from its scene and its goal to its end: the whole runtime on one page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from time import perf_counter

from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.assignment import Assignment, Perform, Prepared, Reach, Refused, prepare
from skillc_runtime.attempt import Attempt, Setting, attempt
from skillc_runtime.planning.plan import Step
from skillc_runtime.plans.failures import Failures
from skillc_runtime.plans.progress import progress
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.simulation.cell import SimulatedCell
from skillc_runtime.trace.events import FORMAT, Listener, Replanned, TaskEnded, TaskStarted
from skillc_runtime.trace.failure import Failure
from skillc_runtime.trace.known import KnownFact, assumed
from skillc_runtime.trace.listeners import Listeners
from skillc_runtime.verifying import known_facts
from skillc_runtime.world.eval.conditions import evaluate

MOST_ATTEMPTS = 4
"""A goal is given up when so many plans have failed."""


@dataclass(frozen=True, slots=True)
class Execution:
    """What became of a prepared task: its attempts, how it ended, the cell it left behind, how long it took.

    `facts` are those that a success rests on.
    """

    attempts: tuple[Attempt, ...]
    status: Status
    failure: Failure | None
    cell: SimulatedCell
    wall_time_s: float
    facts: tuple[KnownFact, ...] = ()

    @property
    def verified(self) -> bool | None:
        """Whether nothing that a success rests on is only assumed; None where there is no success."""
        return _verified(self.status, self.facts)

    @property
    def last(self) -> Attempt:
        """The attempt that ended the task."""
        return self.attempts[-1]


def execute(
    prepared: Prepared,
    library: SkillLibrary,
    cell: SimulatedCell,
    listeners: Sequence[Listener] = (),
    watch: Callable[[], None] = lambda: None,
    interrupted: Callable[[], bool] = lambda: False,
) -> Execution:
    """Run a prepared task to its end; `watch` is called after every tick.

    A plan that fails, or that no longer leads to the goal since the world took another turn, is replaced by a new one,
    `MOST_ATTEMPTS` in all. An implementation that failed is not taken again while nothing that it depends on has
    changed. When `interrupted` becomes true everything is halted: what pushed lets go, what yielded is stiff again.
    """
    began = perf_counter()
    tell, name = Listeners(listeners), prepared.assignment.name
    setting = Setting(library, cell, listeners, watch, interrupted, Failures(library))
    tell(TaskStarted(time=cell.now, format=FORMAT, task=name, library=library.name, hash=library.hash))
    attempts = [attempt(prepared, setting, 0)]
    while isinstance(following := _following(attempts, setting), Prepared):
        tell(Replanned(time=cell.now, reason=attempts[-1].why))
        attempts.append(attempt(following, setting, attempts[-1].last_node))
    status, failure = _end(attempts[-1], following)
    facts = _facts(attempts[-1], cell) if status is Status.SUCCESS else ()
    verified = _verified(status, facts)
    tell(TaskEnded(time=cell.now, task=name, status=status.value, failure=failure, verified=verified, facts=facts))
    return Execution(tuple(attempts), status, failure, cell, perf_counter() - began, facts)


def _facts(last: Attempt, cell: SimulatedCell) -> tuple[KnownFact, ...]:
    """Return what a success rests on: the goal, or what the calls of a body claim."""
    match last.prepared.assignment.aim:
        case Reach(goal):
            return known_facts([(goal, {})], cell.world)
        case Perform():
            return known_facts(last.claims, cell.world)


def _verified(status: Status, facts: tuple[KnownFact, ...]) -> bool | None:
    return None if status is not Status.SUCCESS else not assumed(facts)


def _following(attempts: Sequence[Attempt], setting: Setting) -> Prepared | Refused | None:
    """Return what to run next, why there is nothing left to try, or None where the task is over."""
    last, library = attempts[-1], setting.library
    assignment, aim = last.prepared.assignment, last.prepared.assignment.aim
    if not isinstance(aim, Reach) or (last.status is Status.HALTED and last.doubt is None):
        return None
    state = setting.cell.world.snapshot()
    if last.status is Status.SUCCESS and evaluate(aim.goal, state, {}):
        return None
    if last.status is Status.FAILURE and not _blamed(last, setting.failures):
        return None
    if len(attempts) == MOST_ATTEMPTS:
        return Refused(f"the task was tried {MOST_ATTEMPTS} times")
    return _another_way(replace(assignment, state=state), library, setting.failures)


def _blamed(last: Attempt, failures: Failures) -> bool:
    """Whether a step of the plan, or a body that was not planned, failed: another plan may go another way."""
    planned = last.prepared.planned
    return planned is None or any(each in failures.steps for each in progress(planned.steps, last.tree).of("failure"))


def _another_way(now: Assignment, library: SkillLibrary, failures: Failures) -> Prepared | Refused:
    """Plan without the steps that failed; if there is no such plan, without those that can only fail again."""
    answer = prepare(now, library, failures.steps)
    if isinstance(answer, Prepared) or not failures.steps:
        return answer
    without: tuple[Step, ...] = ()
    while isinstance(answer := prepare(now, library, without), Prepared) and answer.planned is not None:
        repeated = failures.repeated(answer.planned.steps, now.state)
        if not repeated:
            return answer
        without = (*without, *repeated)
    if without:
        return Refused(f"what is left has failed, and nothing that it depends on has changed: {failures.listed()}")
    return answer


def _end(last: Attempt, answer: Refused | None) -> tuple[Status, Failure | None]:
    """Return how the task ended: as its last attempt did, unless another plan was wanted and there is none."""
    if answer is None:
        return last.status, last.failure
    message = f"{last.why}; no other way was found: {answer.why}"
    source = last.failure.source if last.failure else None
    return Status.FAILURE, Failure(kind="plan", message=message, source=source)
