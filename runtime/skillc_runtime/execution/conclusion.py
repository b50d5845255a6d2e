"""Decides after an attempt whether its task has ended, and how a plan whose step failed can go on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import TypeAlias

import msgspec
from msgspec.structs import replace

from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.assignment import (
    AchieveGoal,
    ExecuteBody,
    NotStarted,
    PreparedTask,
    Sensed,
    arrange_prepared,
)
from skillc_runtime.execution.attempt import AttemptResult
from skillc_runtime.execution.plans.failed_steps import FailedStep, FailedSteps
from skillc_runtime.execution.success_facts import collect_success_facts
from skillc_runtime.planning.plan import Solved, Step
from skillc_runtime.planning.validation import PlanError, bind_parameters, compute_effects
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.known_facts import KnownFact
from skillc_runtime.recording.states import EndState
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.grounds import find_grounds
from skillc_runtime.world.state.facts import Fact
from skillc_runtime.world.state.labels.labelled_text import format_fact
from skillc_runtime.world.state.labels.labelling import label_fact
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

MAX_ATTEMPTS = 4
"""How many plans are tried for one goal."""

_END_STATES: dict[Status, EndState] = {
    Status.SUCCESS: "succeeded",
    Status.FAILURE: "failed",
    Status.HALTED: "stopped",
}


class Ended(msgspec.Struct, frozen=True):
    """The task has ended."""

    state: EndState
    failure: Failure | None


class NeedsPlan(msgspec.Struct, frozen=True):
    """Another plan may still lead to the goal."""


Conclusion: TypeAlias = Ended | NeedsPlan


def conclude(attempts: Sequence[AttemptResult], failures: FailedSteps, world: WorldModel) -> Conclusion:
    """Return whether a task has ended with its last attempt, after which the world is as it is now.

    A goal that holds only by what a failed step assumed is not reached.
    """
    last, ended = attempts[-1], Ended(_END_STATES[attempts[-1].status], attempts[-1].failure)
    objective = last.prepared.assignment.objective
    if not isinstance(objective, AchieveGoal) or (last.status is Status.HALTED and last.invalidated is None):
        return ended
    if last.status is Status.SUCCESS and evaluate(objective.goal, world.snapshot(), {}):
        doubt = _find_doubt(objective.goal, failures, world)
        return ended if doubt is None else Ended("failed", doubt)
    if last.status is Status.FAILURE and not _has_failed_step(last, failures):
        return ended
    if last.is_look:
        return NeedsPlan()
    if sum(not each.is_look for each in attempts) == MAX_ATTEMPTS:
        enough = NotStarted(f"the task was tried {MAX_ATTEMPTS} times")
        return Ended("failed", no_other_plan(attempts, failures, enough))
    return NeedsPlan()


def find_sensed(last: AttemptResult, library: SkillLibrary, state: WorldState) -> Sensed | None:
    """Return what has come of the last step of a policy, whose attempt has ended in `state`; None if it is none."""
    planned = last.prepared.planned
    if planned is None or not last.is_look:
        return None
    plan = planned.solved.plan
    look = plan.steps[-1]
    true = [
        each.label
        for each in library.skills[look.skill].outcomes
        if evaluate(each.condition, state, bind_parameters(look, library, state))
    ]
    branch = plan.find_branch(true[0]) if true else None
    known = None if branch is None else Solved(branch, "best found", planned.solved.planner)
    return Sensed(f"{look.skill} has ended with `{'` and `'.join(true)}`", known)


def _has_failed_step(last: AttemptResult, failures: FailedSteps) -> bool:
    """Whether a step of the plan failed, or a body that was not planned: another plan may avoid it."""
    planned = last.prepared.planned is not None
    return not planned or any(step.with_outcome("") in failures.steps for step in last.steps_with_status("failure"))


def no_other_plan(attempts: Sequence[AttemptResult], failures: FailedSteps, answer: NotStarted) -> Failure:
    """Return the failure of a task that needed a plan after its attempts, if there were any, and got `answer`.

    Its cause is that of the last attempt, or what an earlier one measured if nothing was tried in the last one.
    """
    if not attempts:
        return Failure(kind="plan", message=answer.reason, detail=answer.detail)
    last = attempts[-1]
    tried, cause = failures.failures, None if last.invalidated is not None else last.failure
    if cause is not None and cause.is_unmet_need:
        cause = next((each for each in reversed(tried) if not each.is_unmet_need), cause)
    message = last.reason if cause is None else cause.message
    leading = [each for each in tried if each.message == message] or [each for each in (cause,) if each is not None]
    unknown = answer.reason.removeprefix("no plan was found: ")
    end = "no other plan was found" + ("" if answer.proved else f": {unknown}")
    why = Failure(kind="plan", message=end, detail="; ".join(filter(None, (answer.reason, answer.detail))))
    causes = (*leading, *(each for each in tried if each.message != message), why)
    return Failure(kind="plan", message=message, source=cause.source if cause else None, causes=causes)


def collect_facts(last: AttemptResult, world: WorldModel, with_physics: bool) -> tuple[KnownFact, ...]:
    """Return the facts that a success rests on: those of the goal, or of the posts of the body's calls.

    `with_physics` is whether the cell is a simulation with physics.
    """
    match last.prepared.assignment.objective:
        case AchieveGoal(goal):
            return collect_success_facts([(goal, {})], world, with_physics)
        case ExecuteBody():
            return collect_success_facts(last.claims, world, with_physics)


def continue_plan(last: AttemptResult, library: SkillLibrary, state: WorldState) -> PreparedTask:
    """Return the failed step and those after it, or the whole of a body that was not planned.

    PlanError if the rest of the plan is no longer possible.
    """
    assignment, planned = replace(last.prepared.assignment, state=state), last.prepared.planned
    if planned is None:
        return PreparedTask(assignment, last.prepared.body, None, last.prepared.space)
    return _prepare_steps(last, last.steps_with_status("failure", "halted", "idle"), library, state)


def skip_failed_step(last: AttemptResult, library: SkillLibrary, world: WorldModel, origin: str) -> PreparedTask:
    """Write the effects of the failed step as assumptions, and return the steps after it.

    PlanError if nothing was planned, or the rest is not possible; the world is as before then.
    """
    failed = last.steps_with_status("failure")
    if not failed:
        raise PlanError("only a step of a plan can be skipped")
    try:
        changes = [each for step in failed for each in compute_effects(step, library, world.snapshot())]
        after = WorldModel(world.snapshot()).commit(changes).after
        prepared = _prepare_steps(last, last.steps_with_status("halted", "idle"), library, after)
        world.commit(changes, origin, "assumed")
    except (EvaluationError, WorldError) as error:
        raise PlanError(str(error)) from error
    return replace(prepared, assignment=replace(prepared.assignment, state=world.snapshot()))


def _prepare_steps(
    last: AttemptResult, steps: tuple[Step, ...], library: SkillLibrary, state: WorldState
) -> PreparedTask:
    """Return some steps of the plan as a body; PlanError if they are not possible."""
    assert last.prepared.planned is not None, "steps come from a plan"
    solved, space = last.prepared.planned.solved, last.prepared.space
    rest = replace(solved, plan=solved.plan.keep(steps))
    if space is not None:
        space = space.carry_over(len(steps), "it goes on after a failure")
    return arrange_prepared(replace(last.prepared.assignment, state=state), rest, library, space)


def _find_doubt(goal: Condition, failures: FailedSteps, world: WorldModel) -> Failure | None:
    """Return why a goal that holds does not count as reached; None if it does.

    It does not if a fact that it rests on is only assumed, was to be achieved by a step that failed, and has not been
    written since: a part that was let go in its place may not be there if what followed failed.
    """
    for ground in find_grounds(goal, world, {}):
        if ground.write is None or not ground.is_assumed:
            continue
        for failed in failures.failed:
            if ground.write.number <= failed.writes and ground.fact in _to_achieve(failed, failures, world):
                return _describe(failed, format_fact(label_fact(ground.fact, world.snapshot())))
    return None


def _to_achieve(failed: FailedStep, failures: FailedSteps, world: WorldModel) -> Iterator[Fact]:
    """Yield the facts that decide the postconditions of a failed step which did not hold when it started."""
    step = failed.step
    for post in failures.library.skills[step.skill].post:
        with suppress(EvaluationError):  # not every parameter of a call inside a step has a value
            if not evaluate(post.achieved, failed.state, step.arguments):
                yield from (ground.fact for ground in find_grounds(post.achieved, world, step.arguments))


def _describe(failed: FailedStep, fact: str) -> Failure:
    cause = failed.failure
    doubt = Failure(kind="plan", message=f"that `{fact}` is only assumed: {failed.step.skill} has failed since")
    return Failure(kind="post", message=cause.message, source=cause.source, causes=(cause, doubt))
