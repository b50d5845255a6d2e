"""Plans again without the steps that do not go in space, until all steps of a plan go or there is no plan."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias

from skillc_model.skills import SkillLibrary
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.refinement.plan_refinement import PlanRefinement, refine_plan
from skillc_runtime.execution.refinement.scope import find_excluded
from skillc_runtime.execution.refinement.situation import Situation
from skillc_runtime.planning.plan import Excluded, GaveUp, PlanResult, Unsolvable
from skillc_runtime.planning.schedule import Scheduled
from skillc_runtime.world.state.world_state import WorldState

ROUNDS = 30
"""How often is planned at most."""

Answer: TypeAlias = PlanResult | Scheduled


PlanWithout: TypeAlias = Callable[[Sequence[Excluded]], Answer]
"""Plans without some steps."""


def plan_in_space(
    library: SkillLibrary, state: WorldState, plan: PlanWithout, cancel: CancelToken
) -> tuple[Answer, PlanRefinement | None]:
    """Return the first plan whose steps all go in space, and how; else the last answer, and what was found before it.

    `plan` plans without some steps, until `cancel` ends it. A plan with a step that depends on a value which only a run
    will know is returned as it is: nothing is known against it.
    """
    last: PlanRefinement | None = None
    for answer, found in refine_plans(library, state, plan, cancel):
        if found is None:
            return (answer, None) if last is None else (explain(last, state), last)
        last = found
    return answer, last


def refine_plans(
    library: SkillLibrary, state: WorldState, plan: PlanWithout, cancel: CancelToken, begin: Situation | None = None
) -> Iterator[tuple[Answer, PlanRefinement | None]]:
    """Yield plans, each without the steps of those before it that do not go in space, and how far they go.

    The last is one that goes, the answer that there is no other, without a refinement, or one after which nothing more
    is tried. The arms begin at home, or as in the situation `begin`.
    """
    without: list[Excluded] = []
    for _ in range(ROUNDS):
        answer = plan(without)
        if isinstance(answer, Unsolvable | GaveUp):
            yield answer, None
            return
        found = refine_plan(library, state, answer.plan.steps, begin)
        yield answer, found
        if found.failed is None or found.before is None or cancel.reason is not None:
            return
        if found.failure is not None and found.failure.cause == "no-value":
            return
        why = "no way was found" if found.failure is None else found.failure.message
        excluded = find_excluded(library, found.before, found.failed, why)
        if excluded in without:
            return
        without.append(excluded)


def explain(found: PlanRefinement, state: WorldState) -> GaveUp:
    """Return the answer that no plan is known all of whose steps go in space."""
    assert found.failed is not None
    named = ", ".join(state.vocabulary.short(each) for each in found.failed.arguments.values())
    why = found.failure.message if found.failure is not None else "no way was found"
    return GaveUp(
        "the arms can carry out none, for the grasps, postures and places that were tried: "
        f"{found.failed.skill}({named}) does not go: {why}"
    )
