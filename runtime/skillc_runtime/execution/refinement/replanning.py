"""Plans again without the steps that do not go in space, until all steps of a plan go or there is no plan."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

from skillc_model.skills import SkillLibrary
from skillc_runtime.cancellation import Cancelled, CancelToken, cancelling
from skillc_runtime.execution.refinement.plan_refinement import PlanRefinement, refine_plan
from skillc_runtime.execution.refinement.scope import find_excluded
from skillc_runtime.planning.plan import Excluded, GaveUp, LeftOut, PlanResult, Unsolvable
from skillc_runtime.planning.schedule import Scheduled
from skillc_runtime.world.state.world_state import WorldState

ROUNDS = 30
"""How often is planned at most."""

Answer: TypeAlias = PlanResult | Scheduled


def plan_in_space(
    library: SkillLibrary, state: WorldState, plan: Callable[[Sequence[Excluded]], Answer], cancel: CancelToken
) -> tuple[Answer, PlanRefinement | None]:
    """Return the first plan whose steps all go in space, and how; else the last answer, and what was found before it.

    `plan` plans without some steps, until `cancel` ends it. A plan with a step that depends on a value which only a run
    will know is returned as it is: nothing is known against it. What an answer without a plan says to be `needed` has
    all been excluded because of space.
    """
    without: list[Excluded] = []
    in_space = True
    before: tuple[Answer, PlanRefinement] | None = None
    for _ in range(ROUNDS):
        answer = plan(without)
        if isinstance(answer, Unsolvable | GaveUp):
            if before is None or cancel.reason is not None:
                return before or (answer, None)
            needed = answer.needed if isinstance(answer, GaveUp) and in_space else ()
            return _explain(before[1], state, needed), before[1]
        try:
            with cancelling(cancel):
                found = refine_plan(library, state, answer.plan.steps)
        except Cancelled:
            return before or (answer, None)
        if found.failed is None or found.before is None or cancel.reason is not None:
            return answer, found
        if found.failure is not None and found.failure.cause == "no-value":
            return answer, found
        why = "no way was found" if found.failure is None else found.failure.message
        in_space = in_space and found.failure is not None and found.failure.is_in_space
        excluded = find_excluded(library, found.before, found.failed, why)
        if excluded in without:
            return answer, found
        without.append(excluded)
        before = answer, found
    return before if before is not None else (answer, None)


def _explain(found: PlanRefinement, state: WorldState, needed: tuple[LeftOut, ...]) -> GaveUp:
    """Return the answer that no plan is known all of whose steps go in space."""
    assert found.failed is not None
    named = ", ".join(state.vocabulary.short(each) for each in found.failed.arguments.values())
    why = found.failure.message if found.failure is not None else "no way was found"
    return GaveUp(
        "the arms can carry out none, for the grasps, postures and places that were tried: "
        f"{found.failed.skill}({named}) does not go: {why}",
        needed=needed,
    )
