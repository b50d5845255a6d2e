"""The progress of a plan, and whether the rest of it still leads to the goal."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeAlias

from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.plans.plan_body import achieved_condition
from skillc_runtime.planning.foresight import foresee
from skillc_runtime.planning.plan import Step
from skillc_runtime.planning.validation import PlanError, apply_effects, apply_step, check_goal_reached
from skillc_runtime.recording.history.node_outcome import NodeOutcome
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.model import WorldError
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

Progress: TypeAlias = tuple[tuple[Step, NodeOutcome], ...]
"""The steps of a plan in the order of its body, each with the outcome of its node."""

STEP_KINDS = ("call", "if", "sel")
"""The kinds of nodes that run a step of a plan: a call, one that is skipped if nothing is left to do, or two calls."""


def measure_progress(steps: Sequence[Step], tree: NodeOutcome) -> Progress:
    """Return the progress of steps, given in the order of the body that `tree` is the outcome of."""
    return tuple(zip(steps, find_step_outcomes(tree), strict=True))


def find_step_outcomes(tree: NodeOutcome) -> Iterator[NodeOutcome]:
    """Yield the outcome of each step from the outcome of a plan's body."""
    if tree.kind in STEP_KINDS:
        yield tree
    else:
        for child in tree.children:
            yield from find_step_outcomes(child)


def invalidation_reason(
    begun: Sequence[Step], left: Sequence[Step], goal: Condition | None, library: SkillLibrary, state: WorldState
) -> str | None:
    """Return why the plan no longer leads to the goal from `state`, None if it does; without a goal, why not on.

    Steps that have begun are expected to have their effects; those that are left must then be able to start in order.
    """
    library, state = foresee(library, state, goal)
    try:
        for step in begun:
            state = apply_effects(step, library, state)
    except (EvaluationError, WorldError):
        return None  # in the middle of a step the world may be in a state in which its effects make no sense yet
    for step in left:
        achieved = achieved_condition(step, library)
        try:
            state = (
                state if achieved is not None and evaluate(achieved, state, {}) else apply_step(step, library, state)
            )
        except (EvaluationError, PlanError) as reason:
            return f"{step.skill} is no longer possible: {reason}"
    try:
        if goal is not None:
            check_goal_reached(goal, state)
    except PlanError as reason:
        return str(reason)
    return None
