"""How a run continues another one that was interrupted, by the decision of a person."""

from __future__ import annotations

from dataclasses import dataclass
from typing import assert_never

from msgspec.structs import replace

from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.assignment import Assignment, ExecuteBody, PreparedTask, arrange_prepared
from skillc_runtime.execution.plans.plan_body import achieved_condition
from skillc_runtime.execution.remainder import BodyRemainder, PlanRemainder
from skillc_runtime.execution.selection.preflight import preflight
from skillc_runtime.planning.plan import Step
from skillc_runtime.planning.validation import PlanError, apply_step, compute_effects
from skillc_runtime.recording.states import Decision
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

INTERRUPTED = "it goes on after an interruption"
"""Why nobody has looked in space at what is left of a plan or a body."""


@dataclass(frozen=True, slots=True)
class Continuation:
    """How a run begins: with a prepared task, or by planning if None, after `assumed` changes of the world."""

    assignment: Assignment
    prepared: PreparedTask | None = None
    assumed: tuple[Change, ...] = ()


def find_decisions(remainder: PlanRemainder | BodyRemainder | None) -> tuple[Decision, ...]:
    """Return how a run can be continued."""
    match remainder:
        case None:
            return ("replan",)
        case PlanRemainder(begun=begun, waiting=waiting):
            return ("replan", *(("retry",) if begun or waiting else ()), *(("skip",) if begun else ()))
        case BodyRemainder(body):
            return ("retry",) if body is not None else ()
        case _:
            assert_never(remainder)


def continue_run(
    assignment: Assignment,
    remainder: PlanRemainder | BodyRemainder | None,
    decision: Decision,
    library: SkillLibrary,
) -> Continuation:
    """Return how an assignment is continued in its state of the world, by one of the decisions that there are.

    PlanError if what is left is not possible any more.
    """
    match remainder:
        case BodyRemainder(body, space) if body is not None:
            rest = replace(assignment, objective=ExecuteBody(body))
            known = None if space is None else space.carry_over(1, INTERRUPTED)
            return Continuation(rest, _check(PreparedTask(rest, body, None, known), library))
        case PlanRemainder() if decision == "retry":
            return Continuation(
                assignment, _arrange(assignment, remainder, (*remainder.begun, *remainder.waiting), library)
            )
        case PlanRemainder() if decision == "skip":
            return _skip(assignment, remainder, library)
        case _:
            return Continuation(assignment)


def _skip(assignment: Assignment, left: PlanRemainder, library: SkillLibrary) -> Continuation:
    """Return the steps that have not begun, after the effects of those that were running."""
    try:
        assumed = tuple(change for step in left.begun for change in compute_effects(step, library, assignment.state))
        after = WorldModel(assignment.state).commit(assumed).after
    except (EvaluationError, ValueError) as error:
        raise PlanError(str(error)) from error
    return Continuation(assignment, _arrange(replace(assignment, state=after), left, left.waiting, library), assumed)


def _arrange(
    assignment: Assignment, left: PlanRemainder, steps: tuple[Step, ...], library: SkillLibrary
) -> PreparedTask:
    """Return the steps that would not be skipped as a task that can start; PlanError if it cannot."""
    kept = _drop_achieved(steps, library, assignment.state)
    solved = replace(left.solved, plan=left.solved.plan.keep(kept))
    space = None if left.space is None else left.space.carry_over(len(kept), INTERRUPTED)
    return _check(arrange_prepared(assignment, solved, library, space), library)


def _check(prepared: PreparedTask, library: SkillLibrary) -> PreparedTask:
    """Return a task that can start; PlanError if it cannot."""
    refusals = preflight(prepared.body, library, prepared.assignment.state)
    if refusals:
        raise PlanError("\n".join(map(str, refusals)))
    return prepared


def _drop_achieved(steps: tuple[Step, ...], library: SkillLibrary, state: WorldState) -> tuple[Step, ...]:
    """Return the steps that a body of them would not skip; PlanError if one of them is not possible."""
    kept = []
    try:
        for step in steps:
            achieved = achieved_condition(step, library)
            if achieved is None or not evaluate(achieved, state, {}):
                kept.append(step)
                state = apply_step(step, library, state)
    except EvaluationError as error:
        raise PlanError(str(error)) from error
    return tuple(kept)
