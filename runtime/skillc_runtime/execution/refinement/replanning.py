"""Looks at plans in space: what the look at one finds, and which is the first whose steps all go."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_model.conditions import And
from skillc_model.skills import SkillLibrary
from skillc_model.tree import Node
from skillc_runtime.cancellation import Cancelled, CancelToken, cancelling
from skillc_runtime.execution.refinement.failure import Cause
from skillc_runtime.execution.refinement.look import AnswerT, PlanLook, PlanWithout, look_at_plans
from skillc_runtime.execution.refinement.plan_refinement import PlanRefinement, refine_plan
from skillc_runtime.execution.refinement.scope import call_of, find_excluded
from skillc_runtime.execution.refinement.siblings import list_siblings
from skillc_runtime.execution.refinement.situation import Situation
from skillc_runtime.execution.refinement.space_claim import claim_of_body, make_claim
from skillc_runtime.execution.refinement.walk import Scope, Walk
from skillc_runtime.planning.plan import GaveUp, LeftOut, Step, StepWhile
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.world.state.world_state import WorldState

OF_REACH: frozenset[Cause] = frozenset(("out-of-reach", "joint-range", "torque", "no-grasp-or-place"))
"""The causes for which steps with other things or places may not go either."""


def plan_in_space(
    library: SkillLibrary, state: WorldState, plan: PlanWithout[AnswerT], cancel: CancelToken
) -> tuple[AnswerT | GaveUp, PlanRefinement | None]:
    """Return the first plan whose steps all go in space, and how; else that none is known, and what was found last.

    `plan` plans without some steps, until `cancel` ends it. The arms begin at home. A plan with a step that depends on
    a value which only a run will know is returned as it is: nothing is known against it; so is one at which there was
    no time to look. What an answer without a plan says to be `needed` has all been excluded because of space.
    """
    found: PlanRefinement | None = None
    in_space = True

    def look(steps: Sequence[Step]) -> PlanLook:
        nonlocal found, in_space
        try:
            with cancelling(cancel):
                now = refine_plan(library, state, steps)
                seen = judge(library, state, now, steps)
        except Cancelled as why:
            return PlanLook(claim=SpaceClaim(checked=0, steps=len(steps), stopped=str(why)))
        found = now
        in_space = in_space and (now.failure is None or now.failure.is_in_space)
        return seen

    before: tuple[AnswerT, PlanLook] | None = None
    needed: tuple[LeftOut, ...] = ()
    for answer, seen in look_at_plans(plan, look):
        if seen is None or seen.claim.stopped:
            if before is None:
                return answer, None
            needed = answer.needed if isinstance(answer, GaveUp) and in_space and cancel.reason is None else ()
            break
        before = answer, seen
        if cancel.reason is not None:
            break
    assert before is not None, "there is an answer"
    if not before[1].excluded:
        return before[0], found
    return before[1].explain(state, needed, cancel.reason), found


def look_at_plan(
    library: SkillLibrary, begin: Situation, from_home: bool, steps: Sequence[Step], cancel: CancelToken
) -> PlanLook:
    """Return what a look at a plan finds that begins in a situation; Cancelled if `cancel` ends it."""
    with cancelling(cancel):
        return judge(library, begin.state, refine_plan(library, begin.state, steps, begin), steps, from_home)


def look_at_body(library: SkillLibrary, begin: Situation, from_home: bool, body: Node, cancel: CancelToken) -> PlanLook:
    """Return what a look at a body finds that begins in a situation; Cancelled if `cancel` ends it."""
    walk = Walk(library)
    with cancelling(cancel):
        return PlanLook(claim=claim_of_body(next(walk.go(body, begin, Scope({})), None), walk, from_home))


def judge(
    library: SkillLibrary, begin: WorldState, found: PlanRefinement, steps: Sequence[Step], from_home: bool = True
) -> PlanLook:
    """Return what a refinement of steps from a version of the world on says, and what is in the way where it ends."""
    claim = make_claim(found, len(steps), begin.vocabulary, from_home)
    if found.failed is None or found.before is None:
        return PlanLook(claim=claim)
    excluded = [find_excluded(library, begin, found.before, found.failed, claim.failure or "")]
    cause = None if found.failure is None else found.failure.cause
    if cause in OF_REACH and excluded[0].condition == And(()):
        excluded += _exclude_siblings(library, begin, found.before, found.failed, steps)
    return PlanLook(claim=claim, failed=found.failed, cause=cause, found=tuple(excluded))


def _exclude_siblings(
    library: SkillLibrary, begin: WorldState, before: Situation, step: Step, steps: Sequence[Step]
) -> Iterator[StepWhile]:
    """Yield the steps like one that does not go that do not go either for lack of reach, each while that is so."""
    for sibling, there in list_siblings(library, before, step, steps):
        walk = Walk(library)
        went = next(walk.go(call_of(sibling, library), there, Scope({})), None) is not None
        why = walk.furthest
        if not went and why is not None and why.cause in OF_REACH:
            yield find_excluded(library, begin, there, sibling, why.message)
