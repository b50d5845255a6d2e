"""How far a plan has come, and whether what is left of it still leads to the goal."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from skillc_compiler.library.conditions import Condition
from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.planning.plan import Step
from skillc_runtime.planning.validation import PlanError, apply_effects, apply_step, check_goal_reached
from skillc_runtime.plans.body import achieved
from skillc_runtime.trace.outcome import Outcome
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.model import WorldError
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

STEP_KINDS = ("call", "if")
"""What a step of a plan is in its body: a call, or one that is skipped where it has nothing to achieve."""


@dataclass(frozen=True, slots=True)
class Progress:
    """The steps of a plan in the order of its body, each with what became of it."""

    steps: tuple[tuple[Step, Outcome], ...]

    def of(self, status: str) -> tuple[Step, ...]:
        """Return the steps of a status: idle, running, success, failure, halted."""
        return tuple(step for step, outcome in self.steps if outcome.status == status)


def progress(steps: Sequence[Step], tree: Outcome) -> Progress:
    """Return what became of steps, given in the order of the body that the tree is the outcome of."""
    return Progress(tuple(zip(steps, step_outcomes(tree), strict=True)))


def step_outcomes(tree: Outcome) -> Iterator[Outcome]:
    """Yield what became of each step, from the outcome of a plan's body."""
    if tree.kind in STEP_KINDS:
        yield tree
    else:
        for child in tree.children:
            yield from step_outcomes(child)


def doubt(so_far: Progress, goal: Condition, library: SkillLibrary, state: WorldState) -> str | None:
    """Return why the plan no longer leads to the goal from this version of the world, None while it does.

    What runs now is expected to achieve what it is for; what is to come must be able to start after that.
    """
    try:
        for step in so_far.of("running"):
            state = apply_effects(step, library, state)
    except (EvaluationError, WorldError):
        return None  # in the middle of a step the world may be such that its effects make no sense yet
    for step in so_far.of("idle"):
        done = achieved(step, library)
        try:
            state = state if done is not None and evaluate(done, state, {}) else apply_step(step, library, state)
        except (EvaluationError, PlanError) as reason:
            return f"{step.skill} can no longer follow: {reason}"
    try:
        check_goal_reached(goal, state)
    except PlanError as reason:
        return str(reason)
    return None
